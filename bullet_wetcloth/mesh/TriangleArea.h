// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <cmath>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Area of a triangle with sides a, b, c; 0 when they make none. Heron's formula in Kahan's order, which keeps needles
/// accurate (Kahan 2014, "Miscalculating area and angles of a needle-like triangle").
inline double triangleArea(double a, double b, double c) {
  if (a < b) std::swap(a, b);
  if (b < c) std::swap(b, c);
  if (a < b) std::swap(a, b);
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return product > 0 ? std::sqrt(product) / 4 : 0;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
