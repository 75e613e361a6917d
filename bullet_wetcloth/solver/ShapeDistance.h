// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <LinearMath/btVector3.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// How far a point is outside a shape, and which way out is the shortest.
struct ShapeDistance {
  btScalar distance;  ///< [m], negative inside
  btVector3 normal;   ///< of length 1, outwards
};

/// A shape whose distance has a closed form: a box, a sphere, a capsule, a round cylinder or a plane.
class MeasuredShape {
 public:
  /// Whether it is one of these.
  static bool isOne(const btCollisionShape& shape);
  /// For one of these, as it is now.
  explicit MeasuredShape(const btCollisionShape& shape);
  /// Of a point in the shape's own frame [m].
  ShapeDistance distanceTo(const btVector3& point) const;

 private:
  int m_type;
  btVector3 m_extent;  // half of a box's sides, or a plane's normal [m]
  btScalar m_size;     // the radius of what is round, or how far a plane is from the origin [m]
  int m_axis = 1;      // of a capsule or cylinder
  btScalar m_half;     // of a capsule's axis, without its round ends, or of a cylinder's [m]
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
