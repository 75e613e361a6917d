// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/BodyPose.h"
#include "bullet_wetcloth/solver/HullPlanes.h"

#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Polygons around a convex shape, in the shape's frame.
struct ConvexHull {
  struct Plane {
    BodyPoint normal;  ///< outwards, of length 1
    double offset;     ///< of what is inside, along the normal, at most [m]
  };

  std::vector<btVector3> points;     ///< of the shape, from which it was made
  std::vector<BodyPoint> corners;    ///< the same, in double
  std::vector<int> cornerOfPolygon;  ///< of each polygon, one after the other
  std::vector<std::size_t> first;    ///< where each polygon begins there, and one more
  std::vector<Plane> planes;         ///< of each polygon
  HullPlanes sides;                  ///< the same, to measure by
  BodyBox box;

  std::size_t polygons() const { return planes.size(); }
};

/// Hulls of shapes, kept from step to step. A shape may change or be deleted at any time: a hull is told by the points
/// that it was made of.
class ConvexHulls {
 public:
  /// Of shapes with corners it is exact; round ones get one whose corners are on them. Bullet's margin counts where it
  /// is part of the shape: of boxes, cylinders, spheres and capsules, not of hulls of points.
  const ConvexHull& of(const btConvexShape& shape);
  /// Lets go of hulls that were not asked for in many steps.
  void endStep();

 private:
  struct Kept {
    ConvexHull hull;
    int age = 0;  // steps since it was asked for
  };
  std::vector<std::unique_ptr<Kept>> m_kept;
  std::vector<btVector3> m_points;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
