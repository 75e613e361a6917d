// SPDX-License-Identifier: Zlib
// Apart, so that it can be optimized: all of Bullet's springs is in its header, and most of what the tests of the
// deformable world spend their time on.
#include "tests/support/BulletSprings.h"

#include <BulletSoftBody/btDeformableMassSpringForce.h>

namespace wetcloth_test {

std::unique_ptr<btDeformableLagrangianForce> bulletSprings(double stiffness, double damping, SpringDamping acts) {
  return std::make_unique<btDeformableMassSpringForce>(btScalar(stiffness), btScalar(damping),
                                                       acts == SpringDamping::alongSpring);
}

}  // namespace wetcloth_test
