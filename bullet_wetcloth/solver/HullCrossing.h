// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/ConvexHulls.h"

#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Whether triangles reach into a convex hull. Neighbours are asked for one after the other: what keeps one outside
/// mostly does the next.
class HullCrossing {
 public:
  /// Of which hull. @param depth  how deep in it what is outside may be, for rounding [m]
  void begin(const ConvexHull& hull, double depth) {
    m_hull = &hull;
    m_depth = depth;
    m_last = 0;
  }
  /// Of a triangle in the hull's frame.
  bool isIn(const std::array<BodyPoint, 3>& triangle);

 private:
  std::size_t likelyBeyond(const std::array<BodyPoint, 3>& triangle) const;
  bool isBeyond(std::size_t plane, const std::array<BodyPoint, 3>& triangle) const;
  double outside(std::size_t plane, const BodyPoint& point) const;

  const ConvexHull* m_hull = nullptr;
  double m_depth = 0;
  std::size_t m_last = 0;
  std::vector<BodyPoint> m_polygon;
  std::vector<BodyPoint> m_cut;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
