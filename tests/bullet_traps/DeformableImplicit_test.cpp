// SPDX-License-Identifier: Zlib
// The deformable world with implicit integration starts its solve from Node::m_vn, the velocity at the end of the last
// step, so a change of m_v alone is lost. Without projection nothing moves at all.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/Materials.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

namespace wetcloth_test::deformable_implicit_test {

namespace {

struct Push {
  btSoftBody* body;
  bool lastVelocityToo;
  static void apply(btDynamicsWorld* world, btScalar) {
    const Push& push = *static_cast<Push*>(world->getWorldUserInfo());
    for (int i = 0; i < push.body->m_nodes.size(); ++i) {
      push.body->m_nodes[i].m_v += btVector3(0, 0, btScalar(0.1));
      if (push.lastVelocityToo) push.body->m_nodes[i].m_vn += btVector3(0, 0, btScalar(0.1));
    }
  }
};

// Mean velocity along z after 10 pushes of 0.1 m/s.
double gain(WorldKind kind, bool lastVelocityToo) {
  BodyScene scene(kind, sailPatch(4), btVector3(0, 0, 0));
  Push push = {&scene.body(), lastVelocityToo};
  scene.world().setInternalTickCallback(Push::apply, &push, true);
  scene.bullet().step(10);
  return meanVelocity(scene.body()).z();
}

// The fact.
TEST(DeformableImplicit, InPlainBulletAPushOnTheVelocityAloneIsLost) {
  EXPECT_NEAR(gain(WorldKind::deformable, false), 1, 1e-4);
  EXPECT_NEAR(gain(WorldKind::deformableImplicit, false), 0, 1e-4);
  EXPECT_NEAR(gain(WorldKind::deformableImplicit, true), 1, 1e-4);
}

TEST(DeformableImplicit, OurPushIsNotLost) {
  BodyScene scene(WorldKind::deformableImplicit, sailPatch(4), btVector3(0, 0, 0));
  wetcloth::WetClothWorld wet(scene.world());
  addCall(wet.add(scene.body()), [](wetcloth::WetCloth& cloth, const wetcloth::Step&) {
    for (int i = 0; i < cloth.nodeCount(); ++i) cloth.push(cloth.body().m_nodes[i], btVector3(0, 0, btScalar(0.1)));
  });
  scene.bullet().step(10);
  EXPECT_NEAR(meanVelocity(scene.body()).z(), 1, 1e-4);
}

// Momentum of arriving water is a change of velocity too: at rest, it slows the falling cloth by m / (m + dm).
TEST(DeformableImplicit, MomentumOfWaterIsNotLost) {
  double speed[2];
  for (const WorldKind kind : {WorldKind::deformable, WorldKind::deformableImplicit}) {
    BodyScene scene(kind, sailPatch(4), btVector3(0, 0, 0));
    wetcloth::WetClothWorld wet(scene.world());
    wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(1, 1));
    wetcloth::Absorption::Parameters rain;
    rain.waterVelocity = btVector3(0, -8, 0);
    cloth.add<wetcloth::Absorption>(rain);
    scene.bullet().step(240);
    const double saturation = cloth.meanSaturation();
    speed[kind == WorldKind::deformableImplicit] = meanVelocity(scene.body()).y();
    // Each node: (dm u) / (m + dm) with dm = saturation x m.
    EXPECT_NEAR(meanVelocity(scene.body()).y(), -8 * saturation / (1 + saturation), 1e-3) << kind;
  }
  EXPECT_NEAR(speed[0], speed[1], 1e-3);
}

// The fact: documented, since it is not ours to mend.
TEST(DeformableImplicit, WithoutProjectionNothingMoves) {
  BodyScene scene(WorldKind::deformableImplicit, sailPatch(4));
  scene.bullet().deformable().setUseProjection(false);
  const std::vector<btScalar> before = stateOf(scene.body());
  scene.bullet().step(60);
  EXPECT_EQ(meanPosition(scene.body()).y(), btScalar(0.5)) << "half a metre up, where it began";
}

TEST(DeformableImplicit, WithProjectionItFalls) {
  BodyScene scene(WorldKind::deformableImplicit, sailPatch(4));
  scene.bullet().step(60);
  EXPECT_NEAR(meanPosition(scene.body()).y(), 0.5 - 9.81 * 0.25 * 0.25 / 2, 0.01);
}

}  // namespace
}  // namespace wetcloth_test::deformable_implicit_test
