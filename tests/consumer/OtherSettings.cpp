// SPDX-License-Identifier: Zlib
// An application that is compiled with _GLIBCXX_DEBUG, which the library is not: 0 when it hears so before anything is
// read wrongly, 77 where the standard library knows no such setting.
#include <bullet_wetcloth/bullet_wetcloth.h>

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

int main() {
  if (sizeof(std::vector<double>) == 3 * sizeof(double*)) return 77;
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  try {
    const wetcloth::WetClothWorld wet(world);
  } catch (const std::invalid_argument& error) {
    std::puts(error.what());
    return std::string(error.what()).find("sizeof(std::vector) in the program") == 0 ? 0 : 1;
  }
  std::puts("nothing was refused");
  return 1;
}
