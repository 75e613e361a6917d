// SPDX-License-Identifier: Zlib
// A cotton towel hangs by two corners in a light wind and soaks for ten seconds.
//
// The first half of main() is Bullet as you know it; the lines that name wetcloth are all that is new.

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <cstdio>
#include <memory>

int main() {
  // A Bullet world with soft bodies.
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, btScalar(-9.81), 0));
  world.getWorldInfo().m_gravity = world.getGravity();  // soft bodies read their own copy
  world.getWorldInfo().m_sparsesdf.Initialize();

  // A cloth, one metre square. Any btSoftBody with faces will do; the patch is there if you have none yet.
  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = 20;
  patch.edgeV = btVector3(0, 1, 0);
  patch.arealDensity = wetcloth::Fabric::cotton().arealDensity;
  patch.pinnedCorners = {wetcloth::ClothPatch::Corner::topLeft, wetcloth::ClothPatch::Corner::topRight};
  const std::unique_ptr<btSoftBody> cloth = patch.build(world.getWorldInfo());
  cloth->m_cfg.piterations = 10;
  world.addSoftBody(cloth.get());

  // It gets wet.
  wetcloth::WetClothWorld wet(world);
  wetcloth::WetCloth& towel = wet.add(*cloth, wetcloth::Fabric::cotton());
  towel.add<wetcloth::Absorption>();
  adjust(towel.add<wetcloth::Wind>(), [](auto& wind) { wind.velocity = btVector3(1, 0, 2); });  // [m/s]

  // Your loop, unchanged.
  std::printf("time [s]  mass [g]  saturation  colour (linear RGB)   lower edge downwind [m]\n");
  for (int frame = 0; frame <= 600; ++frame) {
    if (frame % 120 == 0) {
      const int node = patch.node(10, 0);
      const wetcloth::Colour colour = towel.colour(node);
      std::printf("%8d  %8.1f  %10.3f  %.3f  %.3f  %.3f  %12.3f\n", frame / 60, 1000 * towel.totalMass(),
                  towel.meanSaturation(), colour.r, colour.g, colour.b, cloth->m_nodes[node].m_x.z());
    }
    world.stepSimulation(btScalar(1) / 60, 4, btScalar(1) / 240);
  }

  const wetcloth::Ledger ledger = towel.ledger();
  std::printf("Absorbed %.2f g, holds %.2f g.\n", 1000 * ledger.absorbed, 1000 * ledger.held);

  world.removeSoftBody(cloth.get());  // Bullet wants a body out of the world before it is deleted
  return std::fabs(ledger.imbalance()) < 1e-12 && ledger.held > 0 ? 0 : 1;
}
