// SPDX-License-Identifier: Zlib
#include "command/pictures/gl/Extent.h"

#include "command/pictures/PosedSolid.h"
#include "command/pictures/VectorMath.h"

#include <algorithm>
#include <cstddef>

namespace pictures {

Extent extentOf(const std::vector<Vector3>& points) {
  if (points.empty()) return {};
  Vector3 low = points.front();
  Vector3 high = low;
  for (const Vector3& point : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], point[i]);
      high[i] = std::max(high[i], point[i]);
    }
  }
  return {(low + high) * 0.5F, std::max(0.5F * length(high - low), 1e-3F)};
}

std::vector<Vector3> pointsOf(const Scenery& scenery, const Frame& frame) {
  std::vector<Vector3> points;
  for (const ClothState& cloth : frame.cloths) {
    points.insert(points.end(), cloth.positions.begin(), cloth.positions.end());
  }
  const std::vector<Vector3> solids = posedVertices(scenery, frame);
  points.insert(points.end(), solids.begin(), solids.end());
  return points;
}

}  // namespace pictures
