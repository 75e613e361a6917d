// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/state/StateArchive.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A world's broadphase: its two trees of boxes, which objects have moved lately, and the order of the overlapping
/// pairs, in which contacts are found. Throws StateError when it is no btDbvtBroadphase, or its cache of pairs is one
/// that removes them later.
void transferBroadphase(StateArchive& archive, btCollisionWorld& world);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
