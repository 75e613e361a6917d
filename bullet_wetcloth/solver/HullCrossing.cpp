// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/HullCrossing.h"

#include <algorithm>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

double HullCrossing::outside(std::size_t plane, const BodyPoint& point) const {
  const ConvexHull::Plane& p = m_hull->planes[plane];
  return p.normal[0] * point[0] + p.normal[1] * point[1] + p.normal[2] * point[2] - p.offset + m_depth;
}

bool HullCrossing::isBeyond(std::size_t plane, const std::array<BodyPoint, 3>& triangle) const {
  return std::all_of(triangle.begin(), triangle.end(),
                     [&](const BodyPoint& corner) { return outside(plane, corner) >= 0; });
}

// The plane that its middle is farthest outside of.
std::size_t HullCrossing::likelyBeyond(const std::array<BodyPoint, 3>& triangle) const {
  btVector3 middle(0, 0, 0);
  for (const BodyPoint& corner : triangle) {
    for (std::size_t k = 0; k < 3; ++k) middle[static_cast<int>(k)] += static_cast<btScalar>(corner[k] / 3);
  }
  return m_hull->sides.farthestFrom(middle);
}

// What the planes leave of the triangle, one after the other.
bool HullCrossing::isIn(const std::array<BodyPoint, 3>& triangle) {
  if (m_hull->polygons() == 0 || isBeyond(m_last, triangle)) return false;
  m_last = likelyBeyond(triangle);
  if (isBeyond(m_last, triangle)) return false;
  for (std::size_t plane = 0; plane < m_hull->polygons(); ++plane) {
    if (!isBeyond(plane, triangle)) continue;
    m_last = plane;
    return false;
  }
  m_polygon.assign(triangle.begin(), triangle.end());
  for (std::size_t plane = 0; plane < m_hull->polygons() && !m_polygon.empty(); ++plane) {
    m_cut.clear();
    for (std::size_t k = 0; k < m_polygon.size(); ++k) {
      const BodyPoint& a = m_polygon[k];
      const BodyPoint& b = m_polygon[(k + 1) % m_polygon.size()];
      const double atA = outside(plane, a);
      const double atB = outside(plane, b);
      if (atA < 0) m_cut.push_back(a);
      if ((atA < 0) == (atB < 0)) continue;
      const double share = atA / (atA - atB);
      BodyPoint crossing;
      for (std::size_t i = 0; i < 3; ++i) crossing[i] = a[i] + share * (b[i] - a[i]);
      m_cut.push_back(crossing);
    }
    std::swap(m_polygon, m_cut);
  }
  return !m_polygon.empty();
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
