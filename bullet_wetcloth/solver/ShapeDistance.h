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

/// Whether distanceTo() knows this shape: boxes, spheres and planes.
bool hasDistance(const btCollisionShape& shape);
/// Of a point in the shape's own frame [m], by the closed form.
ShapeDistance distanceTo(const btCollisionShape& shape, const btVector3& point);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
