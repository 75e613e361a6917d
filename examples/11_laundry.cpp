// SPDX-License-Identifier: Zlib
// A towel from the bucket hangs on the line: the water sinks, drips, first fast and then slowly, and what stays dries.
// Nothing but the effects that are named here is computed.

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <cstdio>
#include <memory>

int main() {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.getWorldInfo().m_gravity = btVector3(0, btScalar(-9.81), 0);
  world.getWorldInfo().m_sparsesdf.Initialize();

  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = 12;
  patch.edgeV = btVector3(0, 1, 0);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  const std::unique_ptr<btSoftBody> cloth = patch.build(world.getWorldInfo());
  world.addSoftBody(cloth.get());

  wetcloth::WetClothWorld wet(world);
  wetcloth::WetCloth& towel = wet.add(*cloth, wetcloth::Fabric::cotton());
  towel.setSaturation(1);
  towel.add<wetcloth::Diffusion>();
  towel.add<wetcloth::Seepage>();
  towel.add<wetcloth::Dripping>();
  wetcloth::Drying::Parameters air;  // a warm and windy day
  air.temperature = 30;
  air.relativeHumidity = 0.4;
  air.air = btVector3(0, 0, 4);
  towel.add<wetcloth::Drying>(air);

  std::printf("time [min]  mass [g]  held [g]  dripped [g]  evaporated [g]  top  hem (saturation)\n");
  for (int minute = 0; minute <= 30; ++minute) {
    const wetcloth::Ledger ledger = towel.ledger();
    if (minute < 5 || minute % 5 == 0) {
      std::printf("%10d  %8.1f  %8.2f  %11.2f  %14.2f  %.2f  %.2f\n", minute, 1000 * towel.totalMass(),
                  1000 * ledger.held, 1000 * ledger.dripped, 1000 * ledger.evaporated,
                  towel.saturation(patch.node(6, 11)), towel.saturation(patch.node(6, 0)));
    }
    for (int frame = 0; frame < 60 * 30; ++frame) world.stepSimulation(btScalar(1) / 30, 0);
  }

  const wetcloth::Ledger ledger = towel.ledger();
  world.removeSoftBody(cloth.get());
  return std::fabs(ledger.imbalance()) < 1e-12 && ledger.dripped > 0 && ledger.evaporated > 0 ? 0 : 1;
}
