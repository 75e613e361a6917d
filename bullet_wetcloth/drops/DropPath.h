// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/audit/SweptBoxes.h"
#include "bullet_wetcloth/drops/DropList.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The straight way of a drop in a substep.
struct DropPath {
  Double3 from;  ///< [m]
  Double3 to;    ///< [m]

  Double3 at(double time) const {
    Double3 place;
    for (std::size_t k = 0; k < 3; ++k) place[k] = from[k] + (to[k] - from[k]) * time;
    return place;
  }
  /// Round the way, in float: outwards by more than its rounding.
  SweptBox box() const {
    constexpr double outwards = 1.2e-7;
    SweptBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      const double low = std::min(from[k], to[k]);
      const double high = std::max(from[k], to[k]);
      box.low[k] = static_cast<float>(low - outwards * std::fabs(low));
      box.high[k] = static_cast<float>(high + outwards * std::fabs(high));
    }
    return box;
  }
};

/// As Bullet has it.
inline btVector3 asBullet(const Double3& v) {
  return {static_cast<btScalar>(v[0]), static_cast<btScalar>(v[1]), static_cast<btScalar>(v[2])};
}

/// As double.
inline Double3 asDouble(const btVector3& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
