// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/state/StateArchive.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Where an object is, whether it sleeps and since when; and of a rigid body its velocities, and the forces that the
/// application has put on it for the next step. Masses, shapes and materials are the application's.
void transferCollisionObject(StateArchive& archive, btCollisionObject& object);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
