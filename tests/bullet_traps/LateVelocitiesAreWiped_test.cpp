// SPDX-License-Identifier: Zlib
// In the soft-rigid world the position solve recomputes m_v from positions after the actions and the post-tick
// callback ran, so velocities written there are lost. The pre-tick callback is the one seam for all three worlds.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

namespace wetcloth_test::late_velocities_are_wiped_test {

namespace {

class PushingAction : public btActionInterface {
 public:
  explicit PushingAction(btSoftBody& body) : m_body(body) {}
  void updateAction(btCollisionWorld*, btScalar) override { m_body.setVelocity(btVector3(0, 0, 1)); }
  void debugDraw(btIDebugDraw*) override {}

 private:
  btSoftBody& m_body;
};

void pushAfterTick(btDynamicsWorld* world, btScalar) {
  static_cast<btSoftBody*>(world->getWorldUserInfo())->setVelocity(btVector3(0, 0, 1));
}

// The fact, for an action.
TEST(LateVelocitiesAreWiped, OfAnActionInPlainBullet) {
  for (const WorldKind kind : {WorldKind::softRigid, WorldKind::softMultiBody}) {
    BodyScene scene(kind, sailPatch(4), kNoGravity);
    PushingAction action(scene.body());
    scene.world().addAction(&action);
    scene.bullet().step(24);
    scene.world().removeAction(&action);
    EXPECT_EQ(meanPosition(scene.body()).z(), 0) << kind;
    EXPECT_EQ(meanVelocity(scene.body()).z(), 0) << kind;
  }
}

// The fact, for the post-tick callback.
TEST(LateVelocitiesAreWiped, OfThePostTickInPlainBullet) {
  for (const WorldKind kind : {WorldKind::softRigid, WorldKind::softMultiBody}) {
    BodyScene scene(kind, sailPatch(4), kNoGravity);
    scene.world().setInternalTickCallback(pushAfterTick, &scene.body(), false);
    scene.bullet().step(24);
    EXPECT_EQ(meanPosition(scene.body()).z(), 0) << kind;
    EXPECT_EQ(meanVelocity(scene.body()).z(), 0) << kind;
  }
}

// 1 m/s, given once: after 0.1 s the cloth is 0.1 m away and still moving.
TEST_IN_EVERY_WORLD(OneEarlyPush, Lasts) {
  BodyScene scene(GetParam(), sailPatch(4), kNoGravity);
  wetcloth::WetClothWorld wet(scene.world());
  bool pushed = false;
  addCall(wet.add(scene.body()), [&pushed](wetcloth::WetCloth& cloth, const wetcloth::Step&) {
    if (pushed) return;
    pushed = true;
    for (int i = 0; i < cloth.nodeCount(); ++i) cloth.push(cloth.body().m_nodes[i], btVector3(0, 0, 1));
  });
  scene.bullet().step(24);
  // Rounding of 24 steps, and the deformable solver's own tolerance.
  EXPECT_NEAR(meanVelocity(scene.body()).z(), 1, 1e-4);
  EXPECT_NEAR(meanPosition(scene.body()).z(), 0.1, 1e-4);
}

}  // namespace
}  // namespace wetcloth_test::late_velocities_are_wiped_test
