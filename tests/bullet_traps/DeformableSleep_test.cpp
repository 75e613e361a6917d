// SPDX-License-Identifier: Zlib
// The deformable world lets soft bodies sleep; the other two do not. A sleeping body is neither predicted nor collided,
// but its positions still move by its velocities, so pushing it every step would drag it through everything.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

namespace wetcloth_test::deformable_sleep_test {

namespace {

constexpr int kUntilAsleep = 5 * 240;  // Bullet waits for 2 s of rest

void pushOnce(btDynamicsWorld* world, btScalar) {
  btSoftBody& body = *static_cast<btSoftBody*>(world->getWorldUserInfo());
  body.addVelocity(btVector3(0, 0, 1));
}

// The fact.
TEST_IN_DEFORMABLE_WORLDS(DeformableSleep, InPlainBulletARestingBodySleepsAndAPushStillMovesIt) {
  BodyScene scene(GetParam(), sailPatch(4), kNoGravity);
  scene.bullet().step(kUntilAsleep);
  ASSERT_EQ(scene.body().getActivationState(), ISLAND_SLEEPING);
  scene.world().setInternalTickCallback(pushOnce, &scene.body(), true);
  scene.bullet().step(1);
  EXPECT_EQ(scene.body().getActivationState(), ISLAND_SLEEPING);
  EXPECT_GT(meanPosition(scene.body()).z(), 0) << "it moved in its sleep";
}

// The fact.
TEST(DeformableSleepElsewhere, InPlainBulletTheOtherWorldsNeverPutASoftBodyToSleep) {
  for (const WorldKind kind : {WorldKind::softRigid, WorldKind::softMultiBody}) {
    BodyScene scene(kind, sailPatch(4), kNoGravity);
    scene.bullet().step(kUntilAsleep);
    EXPECT_TRUE(scene.body().isActive()) << kind;
  }
}

TEST_IN_DEFORMABLE_WORLDS(DeformableSleep, RisingWindWakesTheCloth) {
  BodyScene scene(GetParam(), sailPatch(4), kNoGravity);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::Wind& wind = wet.add(scene.body()).add<wetcloth::Wind>({btVector3(0, 0, 0)});
  scene.bullet().step(kUntilAsleep);
  ASSERT_EQ(scene.body().getActivationState(), ISLAND_SLEEPING);
  adjust(wind, [](auto& p) { p.velocity = btVector3(0, 0, 5); });
  scene.bullet().step(60);
  EXPECT_TRUE(scene.body().isActive());
  EXPECT_GT(meanVelocity(scene.body()).z(), 1);
}

TEST_IN_DEFORMABLE_WORLDS(DeformableSleep, WaterThatLandsIsTakenUpInSleep) {
  BodyScene scene(GetParam(), sailPatch(4), kNoGravity);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(1, 2));
  wetcloth::Absorption& soak = cloth.add<wetcloth::Absorption>({0.0});
  scene.bullet().step(kUntilAsleep);
  ASSERT_EQ(scene.body().getActivationState(), ISLAND_SLEEPING);
  adjust(soak, [](auto& p) { p.exposure = 1.0; });
  scene.bullet().step(480);
  EXPECT_NEAR(cloth.meanSaturation(), 1 - std::exp(-1), 1e-5);  // 480 float steps add up to 2 s
}

// Nothing that pulls steadily may creep a sleeping cloth along: asleep is asleep.
TEST_IN_DEFORMABLE_WORLDS(DeformableSleep, ASteadyPushDoesNotDragASleepingCloth) {
  wetcloth::ClothPatch patch = sailPatch(4);
  BodyScene scene(GetParam(), patch, kNoGravity);
  wetcloth::WetClothWorld wet(scene.world());
  // Wind along the sheet: no force while it is at rest, nothing to wake for.
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  cloth.add<wetcloth::Wind>({btVector3(3, 0, 0)});
  int pushes = 0;
  addCall(cloth, [&pushes](wetcloth::WetCloth& wetCloth, const wetcloth::Step&) {
    ++pushes;
    if (wetCloth.body().getActivationState() != ISLAND_SLEEPING) return;
    for (int i = 0; i < wetCloth.nodeCount(); ++i) {
      wetCloth.push(wetCloth.body().m_nodes[i], btVector3(0, 0, btScalar(1e-3)));
    }
  });
  scene.bullet().step(kUntilAsleep);
  ASSERT_EQ(scene.body().getActivationState(), ISLAND_SLEEPING);
  const std::vector<btScalar> before = stateOf(scene.body());
  scene.bullet().step(240);
  EXPECT_EQ(largestDifference(stateOf(scene.body()), before), 0);
  EXPECT_LT(pushes, kUntilAsleep + 240) << "the stage is not asked to act on a sleeping body";
}

}  // namespace
}  // namespace wetcloth_test::deformable_sleep_test
