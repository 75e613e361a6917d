// SPDX-License-Identifier: Zlib
#pragma once

#include "command/stability/HardCase.h"

#include <string>
#include <vector>

namespace stability {

/// All hard cases, group by group. Their names are unique.
const std::vector<HardCase>& stabilityTable();

std::vector<std::string> caseNames();
std::vector<std::string> groupNames();

/// Steps at which the table is run [s].
const std::vector<double>& stabilitySteps();
/// The few of a quick run.
const std::vector<double>& quickSteps();

/// "1/240" where that is what it is, else the number.
std::string stepName(double step);

}  // namespace stability
