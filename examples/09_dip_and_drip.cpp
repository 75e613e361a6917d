// SPDX-License-Identifier: Zlib
// A towel is let down into water and lifted out again. The water is the surface that Bullet knows already
// (btSoftBodyWorldInfo); each drop that falls from the towel is an event, here a particle that falls back.

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

int main() {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  btSoftBodyWorldInfo& info = world.getWorldInfo();
  info.m_gravity = btVector3(0, btScalar(-9.81), 0);
  info.m_sparsesdf.Initialize();
  info.water_normal = btVector3(0, 1, 0);  // a pond: its surface is at y = 0
  info.water_offset = 0;
  info.water_density = 1000;

  wetcloth::ClothPatch patch;  // half a metre, hung by its top edge, its hem 0.1 m above the pond
  patch.columns = patch.rows = 16;
  patch.origin = btVector3(0, btScalar(0.1), 0);
  patch.edgeU = btVector3(btScalar(0.5), 0, 0);
  patch.edgeV = btVector3(0, btScalar(0.5), 0);
  patch.arealDensity = wetcloth::Fabric::highAbsorption().arealDensity;
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  const std::unique_ptr<btSoftBody> cloth = patch.build(info);
  cloth->m_cfg.piterations = 10;
  world.addSoftBody(cloth.get());

  struct Particle {
    btVector3 position;
    btVector3 velocity;
  };
  std::vector<Particle> drops;
  wetcloth::Dripping::Parameters dripping;
  dripping.onDrip = [&](const wetcloth::Drip& drip) { drops.push_back({drip.position, drip.velocity}); };

  wetcloth::WetClothWorld wet(world);
  wetcloth::WetCloth& towel = wet.add(*cloth, wetcloth::Fabric::highAbsorption());
  towel.add<wetcloth::Immersion>();                                     // below the surface it soaks,
  towel.add<wetcloth::WaterDrag>();                                     // the water carries and slows it;
  towel.add<wetcloth::Seepage>();                                       // above, the water runs down
  wetcloth::Dripping& drips = towel.add<wetcloth::Dripping>(dripping);  // and drips off

  std::printf("time [s]  water [g]  drops  falling\n");
  for (int frame = 0; frame <= 1200; ++frame) {
    if (frame % 120 == 0) {
      std::printf("%8d  %9.1f  %5lld  %7zu\n", frame / 60, 1000 * towel.ledger().held, drips.drops(), drops.size());
    }
    const double time = frame / 60.0;
    const double lift = time < 2 ? -0.3 * time : time < 8 ? -0.6 : std::min(0.1, -0.6 + 0.3 * (time - 8));
    for (int i = 0; i < patch.columns; ++i) cloth->m_nodes[patch.node(i, 15)].m_x.setY(btScalar(0.6 + lift));
    world.stepSimulation(btScalar(1) / 60, 4, btScalar(1) / 240);

    for (Particle& drop : drops) {
      drop.velocity += info.m_gravity / 60;
      drop.position += drop.velocity / 60;
    }
    const auto isBack = [](const Particle& drop) { return drop.position.y() < 0; };
    drops.erase(std::remove_if(drops.begin(), drops.end(), isBack), drops.end());
  }

  const wetcloth::Ledger ledger = towel.ledger();
  std::printf("Took up %.1f g, gave %.1f g back.\n", 1000 * ledger.absorbed, 1000 * ledger.dripped);
  world.removeSoftBody(cloth.get());
  return std::fabs(ledger.imbalance()) < 1e-12 && drips.drops() > 0 ? 0 : 1;
}
