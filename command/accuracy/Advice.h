// SPDX-License-Identifier: Zlib
#pragma once

#include "command/accuracy/Study.h"

#include <string>
#include <vector>

namespace accuracy {

/// The fastest of the points whose error is at most `error`; null when there is none.
const Point* fastestWithin(const std::vector<Point>& points, double error);

/// One sentence: what to take for an error of a few percent, and for the smallest.
std::string adviceOn(const std::vector<Point>& points);

/// A relative error as people read it: "0.3 %", "2e-07".
std::string errorText(double error);

}  // namespace accuracy
