#pragma once

#include "bullet_wetcloth/state/SoftBodyState.h"

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What Bullet's world carries from one step to the next: its clock, the random numbers of its solver, its objects and
/// its broadphase. Contact points between rigid bodies are not saved: they are found anew, without the impulses of the
/// last step to start from.
void transferWorld(StateArchive& archive, btDiscreteDynamicsWorld& world, const SoftBodyArray& bodies);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
