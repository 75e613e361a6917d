// SPDX-License-Identifier: Zlib
// The three fabrics of the paper's Table I soak, each beside its closed form Q(t) / capacity = 1 - exp(-t / theta).
// The update is exact for any step, so large steps cost no accuracy.

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

int main() {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, btScalar(-9.81), 0));
  world.getWorldInfo().m_gravity = world.getGravity();
  world.getWorldInfo().m_sparsesdf.Initialize();
  wetcloth::WetClothWorld wet(world);

  const wetcloth::Fabric fabrics[] = {wetcloth::Fabric::cotton(), wetcloth::Fabric::coarseWool(),
                                      wetcloth::Fabric::highAbsorption()};
  std::unique_ptr<btSoftBody> bodies[3];
  wetcloth::WetCloth* cloths[3];
  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = 8;
  patch.edgeV = btVector3(0, 1, 0);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  for (int i = 0; i < 3; ++i) {
    patch.arealDensity = fabrics[i].arealDensity;
    bodies[i] = patch.build(world.getWorldInfo());
    world.addSoftBody(bodies[i].get());
    cloths[i] = &wet.add(*bodies[i], fabrics[i]);
    cloths[i]->add<wetcloth::Absorption>();
    patch.origin += btVector3(2, 0, 0);
  }

  std::printf("Water over capacity: measured (closed form)\ntime [s]");
  for (const wetcloth::Fabric& fabric : fabrics) std::printf("  %17s", fabric.name.c_str());
  double worst = 0;
  int step = 0;
  for (const int time : {1, 2, 5, 10, 30}) {
    // 1/16 s is exact in binary, so that the times in the table are exact, too.
    for (; step < 16 * time; ++step) world.stepSimulation(btScalar(1) / 16, 0);
    std::printf("\n%8d", time);
    for (int i = 0; i < 3; ++i) {
      const double measured = cloths[i]->meanSaturation();
      const double exact = 1 - std::exp(-time / fabrics[i].timeConstant);
      worst = std::max(worst, std::fabs(measured - exact));
      std::printf("  %7.4f  (%6.4f)", measured, exact);
    }
  }
  std::printf("\ncapacity");
  for (const wetcloth::Fabric& fabric : fabrics) {
    std::printf("  %11.0f g/m^2", 1000 * fabric.capacity * fabric.arealDensity);
  }
  std::printf("\nLargest difference from the closed form: %.1e\n", worst);

  for (const std::unique_ptr<btSoftBody>& body : bodies) world.removeSoftBody(body.get());
  return worst < 1e-12 ? 0 : 1;
}
