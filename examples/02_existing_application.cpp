// SPDX-License-Identifier: Zlib
// An application that already uses Bullet's pre-tick callback (to drag a node, as Bullet's own SoftDemo does), its
// tick callback, and the world's user info. All three keep working when its cloth becomes wet. It may also keep the
// pre-tick callback to itself and call the WetClothWorld from there: Hook::manual.

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cstdio>
#include <memory>

// What the application has, with or without us.
struct Application {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};

  std::unique_ptr<btSoftBody> cloth;
  btSoftBody::Node* picked = nullptr;
  btVector3 mouse = btVector3(btScalar(0.5), 0, 1);
  int dragged = 0;
  int ticks = 0;
  wetcloth::WetClothWorld* wet = nullptr;  // only for Hook::manual

  Application() {
    world.setGravity(btVector3(0, btScalar(-9.81), 0));
    world.getWorldInfo().m_gravity = world.getGravity();
    world.getWorldInfo().m_sparsesdf.Initialize();
    wetcloth::ClothPatch patch;
    patch.columns = patch.rows = 16;
    patch.edgeV = btVector3(0, 1, 0);
    patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
    cloth = patch.build(world.getWorldInfo());
    world.addSoftBody(cloth.get());
    picked = &cloth->m_nodes[patch.node(8, 0)];
    world.setInternalTickCallback(onPreTick, this, true);
    world.setInternalTickCallback(onTick, this, false);
  }
  ~Application() { world.removeSoftBody(cloth.get()); }

  static void onPreTick(btDynamicsWorld* bulletWorld, btScalar dt) {
    Application& app = *static_cast<Application*>(bulletWorld->getWorldUserInfo());
    app.picked->m_v += (app.mouse - app.picked->m_x) * (btScalar(0.05) / dt);
    ++app.dragged;
    if (app.wet) app.wet->preTick(dt);  // the one line that Hook::manual asks for
  }
  static void onTick(btDynamicsWorld* bulletWorld, btScalar) {
    ++static_cast<Application*>(bulletWorld->getWorldUserInfo())->ticks;
  }
  void runOneSecond() {
    for (int frame = 0; frame < 60; ++frame) world.stepSimulation(btScalar(1) / 60, 4, btScalar(1) / 240);
  }
};

// One second wet, and one more after the WetClothWorld is gone; returns where the dragged node was when wet, or zero
// when a callback was left out.
btVector3 run(wetcloth::Hook hook) {
  Application app;
  btVector3 position;
  int ticksWet = 0;
  {
    wetcloth::WetClothWorld wet(app.world, hook);
    if (hook == wetcloth::Hook::manual) app.wet = &wet;
    wetcloth::WetCloth& towel = wet.add(*app.cloth);
    towel.add<wetcloth::Absorption>();
    adjust(towel.add<wetcloth::Wind>(), [](auto& wind) { wind.velocity = btVector3(2, 0, 0); });
    app.runOneSecond();
    position = app.picked->m_x;
    std::printf("%s  saturation %.4f  dragged %d times, %d ticks, node at (%.4f, %.4f, %.4f) m\n",
                hook == wetcloth::Hook::manual ? "Hook::manual " : "Hook::preTick", towel.meanSaturation(), app.dragged,
                app.ticks, position.x(), position.y(), position.z());
    ticksWet = app.ticks;
    app.wet = nullptr;
  }
  app.runOneSecond();
  std::printf("  detached:   dragged %d times, %d ticks\n", app.dragged, app.ticks);
  const bool isComplete = app.dragged == app.ticks && ticksWet > 0 && app.ticks > ticksWet;
  return isComplete ? position : btVector3(0, 0, 0);
}

int main() {
  const btVector3 hooked = run(wetcloth::Hook::preTick);
  const btVector3 manual = run(wetcloth::Hook::manual);
  const bool isSame = hooked == manual && !hooked.isZero();
  std::printf("Both ways give %s cloth.\n", isSame ? "the very same" : "a DIFFERENT");
  return isSame ? 0 : 1;
}
