// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Export.h"
#include "bullet_wetcloth/Precision.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Whether a point is inside a shape or nearer to it than `reach`, by the shape as it is now.
///
/// The shape is what a soft body collides with: a triangle of a mesh, of a plane or of a heightfield is extruded by
/// 6 cm to both sides, and each convex part has its margin. Bullet itself asks a grid that it fills once for each shape
/// (btSparseSdf), which rounds edges off and does not hear of a shape that changed. Allocates nothing.
/// @param point  in the shape's frame
/// @param reach  [m], >= 0
WETCLOTH_EXPORT bool isWithinReach(const btCollisionShape& shape, const btVector3& point, btScalar reach);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
