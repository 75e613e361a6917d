// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/state/StateArchive.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The triangles of planes, meshes and heightfields that soft bodies have come near to. Bullet makes a convex shape of
/// each and keeps it for as long as the boxes overlap; a plane's triangles are what they were when they did first. To
/// be transferred after the broadphase, whose pairs keep them.
/// Throws StateError when a soft body's pair has an algorithm that is not one of Bullet's own.
void transferTriangleCaches(StateArchive& archive, btCollisionWorld& world);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
