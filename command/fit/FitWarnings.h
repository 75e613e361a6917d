// SPDX-License-Identifier: Zlib
#pragma once

#include "command/fit/Task.h"

#include <string>
#include <vector>

namespace fit {

/// Readings that cloth cannot have, each on a line that says what it can: mostly of a unit that is wrong. They can be
/// had before the fit.
std::vector<std::string> doubtsOf(const Task& task);

/// What is wrong with a fit, each on a line: it did not converge; readings are beyond what cloth can have; if none is,
/// its law says little about them, or its values are beyond what cloth can be.
std::vector<std::string> warningsOf(const Task& task, const Fit& fit);

}  // namespace fit
