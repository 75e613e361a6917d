// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/state/SoftBodyState.h"

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What Bullet's world carries from one step to the next: its clock, the random numbers of its solver, its objects,
/// its broadphase, and the contact points of its rigid bodies.
void transferWorld(StateArchive& archive, btDiscreteDynamicsWorld& world, const SoftBodyArray& bodies);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
