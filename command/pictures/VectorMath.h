// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <cmath>

namespace pictures {

inline Vector3 operator+(const Vector3& a, const Vector3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vector3 operator-(const Vector3& a, const Vector3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector3 operator*(const Vector3& a, float factor) { return {a[0] * factor, a[1] * factor, a[2] * factor}; }
inline float dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline float length(const Vector3& a) { return std::sqrt(dot(a, a)); }

/// Of length 1; zero stays zero.
inline Vector3 unit(const Vector3& a) {
  const float size = length(a);
  return size > 1e-12F ? a * (1 / size) : Vector3{0, 0, 0};
}

/// Any direction of length 1 that is perpendicular to `a`, which has length 1.
inline Vector3 perpendicular(const Vector3& a) {
  return unit(std::abs(a[1]) < 0.9F ? cross(a, {0, 1, 0}) : cross(a, {1, 0, 0}));
}

}  // namespace pictures
