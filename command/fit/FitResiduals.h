// SPDX-License-Identifier: Zlib
#pragma once

#include "command/fit/Task.h"

#include <vector>

namespace fit {

/// What a fit leaves of each reading: measured less fitted.
std::vector<double> residualsOf(const Task& task, const Fit& fit);

double rootMeanSquare(const std::vector<double>& numbers);
double standardDeviation(const std::vector<double>& numbers);

}  // namespace fit
