// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btTransform.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A place in double [m].
using BodyPoint = std::array<double, 3>;

inline BodyPoint bodyPointOf(const btVector3& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

/// A transform of Bullet's in double: in float32 a corner 1 km from the world's origin is rounded to 0.06 mm.
class BodyPose {
 public:
  BodyPose() : BodyPose(btTransform::getIdentity(), {0, 0, 0}) {}
  /// Places outside are relative to this origin.
  BodyPose(const btTransform& pose, const BodyPoint& origin) {
    const BodyPoint place = bodyPointOf(pose.getOrigin());
    for (int i = 0; i < 3; ++i) {
      m_basis[static_cast<std::size_t>(i)] = bodyPointOf(pose.getBasis()[i]);
      m_origin[static_cast<std::size_t>(i)] = place[static_cast<std::size_t>(i)] - origin[static_cast<std::size_t>(i)];
    }
  }
  BodyPoint outOf(const BodyPoint& inside) const {
    BodyPoint result = m_origin;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) result[i] += m_basis[i][k] * inside[k];
    }
    return result;
  }
  BodyPoint into(const BodyPoint& outside) const {
    BodyPoint result = {0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) result[i] += m_basis[k][i] * (outside[k] - m_origin[k]);
    }
    return result;
  }

 private:
  std::array<BodyPoint, 3> m_basis;  // rows
  BodyPoint m_origin;
};

/// A box along the axes; empty at first [m].
struct BodyBox {
  BodyPoint low = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity()};
  BodyPoint high = {-low[0], -low[1], -low[2]};

  void include(const BodyPoint& point) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], point[k]);
      high[k] = std::max(high[k], point[k]);
    }
  }
  void include(const BodyBox& other) {
    include(other.low);
    include(other.high);
  }
  void grow(double by) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] -= by;
      high[k] += by;
    }
  }
  bool overlaps(const BodyBox& other) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (low[k] > other.high[k] || other.low[k] > high[k]) return false;
    }
    return true;
  }
  bool contains(const BodyBox& other) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (other.low[k] < low[k] || other.high[k] > high[k]) return false;
    }
    return true;
  }
  /// The corner of this number, [0, 8).
  BodyPoint corner(unsigned which) const {
    return {which & 1 ? high[0] : low[0], which & 2 ? high[1] : low[1], which & 4 ? high[2] : low[2]};
  }
};

/// The box in the pose's own frame that holds a box outside.
inline BodyBox boxInto(const BodyPose& pose, const BodyBox& outside) {
  BodyBox result;
  for (unsigned k = 0; k < 8; ++k) result.include(pose.into(outside.corner(k)));
  return result;
}
/// The other way round.
inline BodyBox boxOutOf(const BodyPose& pose, const BodyBox& inside) {
  BodyBox result;
  for (unsigned k = 0; k < 8; ++k) result.include(pose.outOf(inside.corner(k)));
  return result;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
