// SPDX-License-Identifier: Zlib
// Wet weight stretches a cloth line only if its links are springs. Bullet's position-based links do not see a uniform
// change of mass; HookeSprings takes their place, and the extension follows m g / k.

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <cstdio>
#include <memory>

constexpr int kLinks = 20;           // and as many free nodes
constexpr double kNodeMass = 0.002;  // dry [kg]
constexpr double kStiffness = 100;   // of a link [N/m]
constexpr double kGravity = 9.81;    // [m/s^2]

struct Rope {
  const char* name;
  bool hasSprings;
  double saturation;
  std::unique_ptr<btSoftBody> body = nullptr;
};

int main() {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, btScalar(-kGravity), 0));
  world.getWorldInfo().m_gravity = world.getGravity();
  world.getWorldInfo().m_sparsesdf.Initialize();
  wetcloth::WetClothWorld wet(world);

  Rope ropes[] = {{"Bullet's links, dry", false, 0},
                  {"Bullet's links, saturated", false, 1},
                  {"HookeSprings, dry", true, 0},
                  {"HookeSprings, saturated", true, 1}};
  btVector3 top(0, 0, 0);
  for (Rope& rope : ropes) {
    top += btVector3(1, 0, 0);
    // 1 m long, held at its upper end. Masses are Bullet's, set before the first step.
    rope.body.reset(btSoftBodyHelpers::CreateRope(world.getWorldInfo(), top, top - btVector3(0, 1, 0), kLinks - 1, 1));
    for (int i = 1; i <= kLinks; ++i) rope.body->setMass(i, btScalar(kNodeMass));
    rope.body->m_cfg.kDP = btScalar(0.02);  // to come to rest soon
    rope.body->m_cfg.piterations = 10;
    world.addSoftBody(rope.body.get());
    wetcloth::WetCloth& cloth = wet.add(*rope.body, wetcloth::Fabric::cotton());
    cloth.setSaturation(rope.saturation);
    if (!rope.hasSprings) continue;
    wetcloth::HookeSprings::Parameters springs;
    springs.stiffness = kStiffness;
    cloth.add<wetcloth::HookeSprings>(springs);
  }
  for (int substep = 0; substep < 5 * 240; ++substep) world.stepSimulation(btScalar(1) / 240, 0);

  bool isRight = true;
  std::printf("A rope of 1 m and %d springs hangs   extension [m]  chain of springs [m]\n", kLinks);
  for (Rope& rope : ropes) {
    const double extension = -1 - static_cast<double>(rope.body->m_nodes[kLinks].m_x.y());
    // Each spring bears what hangs below it: sum of i m g / k.
    const double mass = kNodeMass * (1 + rope.saturation * wetcloth::Fabric::cotton().capacity);
    const double chain = mass * kGravity / kStiffness * kLinks * (kLinks + 1) / 2;
    std::printf("%-35s  %13.4f  %20.4f\n", rope.name, extension, chain);
    if (rope.hasSprings) isRight = isRight && std::fabs(extension - chain) < 0.05 * chain;
    world.removeSoftBody(rope.body.get());
  }
  return isRight ? 0 : 1;
}
