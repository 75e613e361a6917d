// SPDX-License-Identifier: Zlib
#pragma once

#include "command/accuracy/Study.h"

#include <optional>
#include <string>
#include <vector>

namespace accuracy {

/// The slope of log(error) over log(knob) by least squares, with its interval of 95 % by Student's t. None with fewer
/// than three points. @param knobs, errors  > 0, as many of one as of the other
std::optional<Order> fitOrder(const std::vector<double>& knobs, const std::vector<double>& errors);

/// The order of each method, from those of its points where the knob decides: above rounding and 4 times the
/// reference's error, below 0.3, where a method has not yet begun to converge, and not on the level end of the curve,
/// if it has one.
std::vector<Order> ordersOf(const std::vector<Point>& points, double referenceError);

/// Richardson's extrapolation: the error of the finer of two results whose steps differ by `ratio`, for a method of
/// this order. |fine - coarse| / (ratio^order - 1).
double richardsonError(double coarse, double fine, double ratio, double order);

}  // namespace accuracy
