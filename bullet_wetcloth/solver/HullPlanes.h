// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/ShapeDistance.h"

#include <LinearMath/btVector3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The planes of a convex polyhedron, so that a processor measures several of them at once.
class HullPlanes {
 public:
  /// One plane more. @param normal  outwards, of length 1  @param offset  of the plane along it [m]
  void add(const std::array<double, 3>& normal, double offset);
  bool isEmpty() const { return m_count == 0; }
  /// Of a point in the hull's own frame [m]: from the plane that it is farthest outside of, or least inside. So it is
  /// exact inside and before a face; before an edge or a corner, less than the distance. Not of an empty one.
  /// @param enough  [m]: of what is farther from some plane it may be that plane's distance
  /// @param likely  a plane that it may be farther outside of: the one of a point beside it. It becomes the one found.
  ShapeDistance distanceTo(const btVector3& point, btScalar enough, std::size_t& likely) const;
  ShapeDistance distanceTo(const btVector3& point) const {
    std::size_t plane = 0;
    return distanceTo(point, BT_LARGE_FLOAT, plane);
  }
  /// The number of the plane that a point is farthest outside of, or least inside, in the order of add().
  std::size_t farthestFrom(const btVector3& point) const {
    std::size_t plane = 0;
    distanceTo(point, BT_LARGE_FLOAT, plane);
    return std::min(plane, m_count - 1);  // the last block is filled up with its last plane
  }

 private:
  static constexpr std::size_t kLanes = 8;
  /// Normals and offsets of eight planes.
  struct Block {
    btScalar normal[3][kLanes];
    btScalar offset[kLanes];
  };
  struct Farthest;

  btVector3 normalOf(std::size_t plane) const;

  std::vector<Block> m_blocks;  // the last one is filled up with its last plane
  std::size_t m_count = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
