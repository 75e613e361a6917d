// SPDX-License-Identifier: Zlib
// Bullet has one pre-tick callback, no getter for it, and one user info that setting either callback overwrites.
// Bullet's own SoftDemo keeps itself in that user info and drags the picked node from its pre-tick callback.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

namespace wetcloth_test::one_pre_tick_slot_test {

namespace {

// A stand-in for SoftDemo and its pickingPreTickCallback.
struct PickingApplication {
  btSoftBody::Node* picked = nullptr;
  btVector3 goal = btVector3(0, 0, 0);
  int calls = 0;

  static void pickingPreTickCallback(btDynamicsWorld* world, btScalar timeStep) {
    auto* application = static_cast<PickingApplication*>(world->getWorldUserInfo());
    ++application->calls;
    if (application->picked == nullptr) return;
    btVector3 delta = application->goal - application->picked->m_x;
    const btScalar maxDrag = 10;
    if (delta.length2() > maxDrag * maxDrag) delta = delta.normalized() * maxDrag;
    application->picked->m_v += delta / timeStep;
  }
};

void countCalls(btDynamicsWorld* world, btScalar) { ++*static_cast<int*>(world->getWorldUserInfo()); }

// The fact.
TEST(OnePreTickSlot, InPlainBulletTheSecondCallerWins) {
  BodyScene scene(WorldKind::softRigid);
  PickingApplication application;
  int others = 0;
  scene.world().setInternalTickCallback(PickingApplication::pickingPreTickCallback, &application, true);
  scene.world().setInternalTickCallback(countCalls, &others, true);
  scene.bullet().step(3);
  EXPECT_EQ(application.calls, 0);
  EXPECT_EQ(others, 3);
}

// The fact: the post-tick callback shares the user info.
TEST(OnePreTickSlot, InPlainBulletThePostTickCallbackTakesTheUserInfo) {
  BodyScene scene(WorldKind::softRigid);
  PickingApplication application;
  int others = 0;
  scene.world().setInternalTickCallback(PickingApplication::pickingPreTickCallback, &application, true);
  scene.world().setInternalTickCallback(countCalls, &others, false);
  EXPECT_EQ(scene.world().getWorldUserInfo(), &others);
}

TEST_IN_EVERY_WORLD(PickingGoesOn, WhileOurWindBlows) {
  BodyScene scene(GetParam(), sailPatch(6), kNoGravity);
  PickingApplication application;
  scene.world().setInternalTickCallback(PickingApplication::pickingPreTickCallback, &application, true);
  wetcloth::WetClothWorld wet(scene.world());
  wet.add(scene.body()).add<wetcloth::Wind>({btVector3(0, 0, 3)});
  scene.bullet().step(10);
  EXPECT_EQ(application.calls, 10);
  EXPECT_EQ(scene.world().getWorldUserInfo(), &application);
  EXPECT_GT(meanVelocity(scene.body()).z(), 0.1) << "the wind blows too";
}

// The picked node is dragged as it is without us: both see the same velocities.
TEST_IN_EVERY_WORLD(PickingGoesOn, WithTheResultThatItHasWithoutUs) {
  std::vector<btScalar> results[2];
  for (const bool withUs : {false, true}) {
    BodyScene scene(GetParam(), sailPatch(6), kNoGravity);
    PickingApplication application;
    application.picked = &scene.body().m_nodes[7];
    application.goal = application.picked->m_x + btVector3(0, btScalar(0.01), btScalar(0.02));
    scene.world().setInternalTickCallback(PickingApplication::pickingPreTickCallback, &application, true);
    std::unique_ptr<wetcloth::WetClothWorld> wet;
    if (withUs) {
      wet = std::make_unique<wetcloth::WetClothWorld>(scene.world());
      wet->add(scene.body());
    }
    scene.bullet().step(20);
    results[withUs] = stateOf(scene.body());
  }
  EXPECT_TRUE(sameBits(results[0], results[1]));
}

TEST_IN_EVERY_WORLD(PickingGoesOn, AfterWeLeft) {
  BodyScene scene(GetParam());
  PickingApplication application;
  scene.world().setInternalTickCallback(PickingApplication::pickingPreTickCallback, &application, true);
  { wetcloth::WetClothWorld wet(scene.world()); }
  EXPECT_EQ(scene.world().getWorldUserInfo(), &application);
  scene.bullet().step(5);
  EXPECT_EQ(application.calls, 5);
}

}  // namespace
}  // namespace wetcloth_test::one_pre_tick_slot_test
