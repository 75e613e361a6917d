// SPDX-License-Identifier: Zlib
// A square of cotton soaks for a second.
#include <bullet_wetcloth/bullet_wetcloth.h>

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cstdio>

int main() {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  const auto cloth = wetcloth::ClothPatch().build(world.getWorldInfo());
  world.addSoftBody(cloth.get());
  double held = 0;
  {
    wetcloth::WetClothWorld wet(world);
    wetcloth::WetCloth& towel = wet.add(*cloth, wetcloth::Fabric::cotton());
    towel.add<wetcloth::Absorption>();
    for (int i = 0; i < 240; ++i) world.stepSimulation(btScalar(1) / 240, 0);
    held = towel.ledger().held;
  }
  world.removeSoftBody(cloth.get());
  std::printf("%.4f kg of water\n", held);
  return held > 0 ? 0 : 1;
}
