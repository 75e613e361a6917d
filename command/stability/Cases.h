// SPDX-License-Identifier: Zlib
#pragma once

#include "command/stability/HardCase.h"

#include <vector>

namespace stability {

std::vector<HardCase> massCases();
std::vector<HardCase> windCases();
std::vector<HardCase> meshCases();
std::vector<HardCase> contactCases();
std::vector<HardCase> timeCases();
std::vector<HardCase> springCases();
std::vector<HardCase> cubicCases();
std::vector<HardCase> guardCases();
std::vector<HardCase> wornCases();
std::vector<HardCase> laundryCases();
std::vector<HardCase> dropCases();

}  // namespace stability
