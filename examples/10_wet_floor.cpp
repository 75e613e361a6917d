// SPDX-License-Identifier: Zlib
// A dry towel falls on a wet floor. Where it touches it takes the water up, and the wetter it is the more the floor
// holds it back: ContactWetting, WetFriction and Cling work on the contacts that Bullet has found.

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

  btBoxShape floorShape(btVector3(2, 1, 2));  // its top is at y = 0
  btRigidBody floor(0, nullptr, &floorShape);
  floor.getWorldTransform().setOrigin(btVector3(0, -1, 0));
  world.addRigidBody(&floor);

  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = 20;
  patch.origin = btVector3(btScalar(-0.5), btScalar(0.3), btScalar(-0.5));
  patch.arealDensity = wetcloth::Fabric::highAbsorption().arealDensity;
  const std::unique_ptr<btSoftBody> cloth = patch.build(world.getWorldInfo());
  cloth->m_cfg.piterations = 10;
  cloth->getCollisionShape()->setMargin(btScalar(0.01));
  world.addSoftBody(cloth.get());

  wetcloth::WetClothWorld wet(world);
  wetcloth::WetCloth& towel = wet.add(*cloth, wetcloth::Fabric::highAbsorption());
  wetcloth::ContactWetting::Parameters contact;
  wetcloth::ContactWetting::WetBody puddle;
  puddle.body = &floor;
  puddle.water = 0.3;  // [kg]
  contact.wetBodies = {puddle};
  wetcloth::ContactWetting& wetting = towel.add<wetcloth::ContactWetting>(contact);
  towel.add<wetcloth::Diffusion>();    // what touches shares with what does not
  towel.add<wetcloth::WetFriction>();  // changes Bullet's friction, contact by contact
  wetcloth::Cling& cling = towel.add<wetcloth::Cling>();

  std::printf("time [s]  on the floor [g]  in the towel [g]  saturation  nodes that cling\n");
  for (int frame = 0; frame <= 480; ++frame) {
    if (frame % 60 == 0) {
      std::printf("%8d  %16.1f  %16.1f  %10.3f  %16d\n", frame / 60, 1000 * wetting.film(floor),
                  1000 * towel.ledger().held, towel.meanSaturation(), static_cast<int>(cling.bonds()));
    }
    world.stepSimulation(btScalar(1) / 60, 4, btScalar(1) / 240);
  }

  const double total = wetting.film(floor) + towel.ledger().held;
  world.removeSoftBody(cloth.get());
  world.removeRigidBody(&floor);
  return std::fabs(total - 0.3) < 1e-12 && towel.ledger().held > 0 ? 0 : 1;
}
