// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/TiltedGlass.h"

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

double heldInTiltedGlass(double radius, double height, double cosine) {
  constexpr double pi = 3.14159265358979323846;
  if (!(cosine > 0)) return 0;
  const double slope = std::sqrt(std::max(0.0, 1 - cosine * cosine)) / cosine;
  if (2 * radius * slope <= height) return pi * radius * radius * (height - radius * slope);
  const double from = radius - height / slope;
  const double root = std::sqrt(std::max(0.0, radius * radius - from * from));
  const double segment = radius * radius * std::acos(std::min(1.0, from / radius)) - from * root;
  return std::max(0.0, slope * (2.0 / 3 * root * root * root - from * segment));
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
