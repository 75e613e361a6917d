// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/state/StateArchive.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The points at which rigid bodies touch each other, with the impulses that Bullet's solver starts the next step from,
/// and the order in which it goes through them. To be transferred after the broadphase, whose pairs own them.
///
/// Restoring lets the pairs that touched collide once more, so that their algorithms and manifolds are there; Bullet's
/// contact callbacks are called as in a step. The application's own data at a point (m_userPersistentData) is not
/// saved.
void transferRigidContacts(StateArchive& archive, btCollisionWorld& world);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
