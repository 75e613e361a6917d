// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletSoftBody/btDeformableLagrangianForce.h>

#include <memory>

namespace wetcloth_test {

/// What the damping of Bullet's own springs acts on: how fast a spring's ends part, which keeps the angular momentum,
/// or any velocity of one end against the other.
enum class SpringDamping { alongSpring, everyDirection };

/// Bullet's own springs of the deformable world [N/m, N s/m].
std::unique_ptr<btDeformableLagrangianForce> bulletSprings(double stiffness, double damping = 0,
                                                           SpringDamping acts = SpringDamping::alongSpring);

}  // namespace wetcloth_test
