// SPDX-License-Identifier: Zlib
// Rain in each of Bullet's worlds: pins, sleep, cuts, places that are no numbers.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "bullet_wetcloth/effects/Rain.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

#include <limits>

namespace wetcloth_test::rain_in_world_test {

namespace {

using wetcloth::Rain;

// Free fall beside the rain: g t and the drops' momentum, m v' = m v + dm u, all in one direction.
TEST_IN_EVERY_WORLD(RainInWorld, PushesAFreeClothByItsMomentum) {
  BodyScene scene(GetParam(), squarePatch(4), btVector3(0, 0, 0));
  scene.body().setActivationState(DISABLE_DEACTIVATION);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  Rain::Parameters rain;
  rain.flux = 0.02;
  cloth.add<Rain>(rain);
  const double dry = cloth.totalMass();
  scene.bullet().step(128, btScalar(1) / 256);
  const double absorbed = cloth.ledger().absorbed;
  // Edge nodes are light in the same measure as they catch little, so the sheet stays flat and level; what is lost by
  // float32 positions, from which Bullet takes velocities: 1e-7 m over 4 ms.
  EXPECT_NEAR(absorbed, 0.02 * 0.5, 1e-7);
  EXPECT_NEAR(double(meanVelocity(scene.body()).y()), -6.5 * absorbed / (dry + absorbed), kIsDouble ? 1e-7 : 1e-3);
}

TEST_IN_EVERY_WORLD(RainInWorld, WetsPinnedNodesAndLeavesThemPinned) {
  BodyScene scene(GetParam(), hangingPatch(5));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  Rain::Parameters rain;
  rain.direction = btVector3(0, 0, -1);  // across the hanging cloth
  rain.flux = 0.1;
  cloth.add<Rain>(rain);
  scene.bullet().step(60);
  for (int i = 20; i < 25; ++i) {
    EXPECT_GT(cloth.saturation(i), 0.01) << i;
    EXPECT_EQ(scene.body().m_nodes[i].m_im, 0);
    EXPECT_EQ(scene.body().m_nodes[i].m_x.y(), 1);
    EXPECT_EQ(scene.body().m_nodes[i].m_v.z(), 0);
  }
  EXPECT_LE(std::fabs(cloth.ledger().imbalance()), 1e-12 * cloth.ledger().held);
}

TEST_IN_EVERY_WORLD(RainInWorld, KeepsABodyAwakeThatItsDropsWouldCarryOff) {
  BodyScene scene(GetParam(), squarePatch(4), btVector3(0, 0, 0));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  cloth.setSaturation(1);
  Rain& rain = cloth.add<Rain>();
  scene.body().setActivationState(ISLAND_SLEEPING);
  scene.bullet().step(1);
  EXPECT_TRUE(scene.body().isActive());
  adjust(rain, [](auto& p) { p.flux = 0; });
  scene.body().setActivationState(ISLAND_SLEEPING);
  wet.preTick(btScalar(0.01));
  EXPECT_FALSE(scene.body().isActive());
}

TEST_IN_EVERY_WORLD(RainInWorld, GoesOnWhenTheBodyIsCut) {
  for (const bool selfShelter : {false, true}) {
    BodyScene scene(GetParam(), hangingPatch(5));
    wetcloth::WetClothWorld wet(scene.world());
    wet.setLog([](const std::string&) {});
    wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
    Rain::Parameters parameters;
    parameters.direction = btVector3(0, 0, 1);
    parameters.selfShelter = selfShelter;
    Rain& rain = cloth.add<Rain>(parameters);
    scene.bullet().step(5);
    ASSERT_TRUE(scene.body().cutLink(scene.body().m_faces[0].m_n[0], scene.body().m_faces[0].m_n[1], btScalar(0.5)));
    scene.bullet().step(1);
    ASSERT_EQ(cloth.nodeCount(), 27);
    const double absorbed = cloth.ledger().absorbed;
    scene.bullet().step(5);
    EXPECT_GT(rain.caught(), 0);
    EXPECT_GT(cloth.ledger().absorbed, absorbed);
    EXPECT_LE(std::fabs(cloth.ledger().imbalance()), 1e-12 * cloth.ledger().held);
  }
}

TEST_IN_EVERY_WORLD(RainInWorld, WritesNoNumberThatIsNone) {
  for (const bool selfShelter : {false, true}) {
    BodyScene scene(GetParam(), squarePatch(4), btVector3(0, 0, 0));
    wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
    wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
    Rain::Parameters parameters;
    parameters.selfShelter = selfShelter;
    cloth.add<Rain>(parameters);
    scene.body().m_nodes[5].m_x.setX(std::numeric_limits<btScalar>::quiet_NaN());
    scene.body().m_nodes[0].m_x.setX(std::numeric_limits<btScalar>::infinity());
    for (int i = 0; i < 3; ++i) wet.preTick(btScalar(0.01));
    for (int i = 0; i < 16; ++i) {
      EXPECT_TRUE(std::isfinite(cloth.held(i)) && cloth.held(i) >= 0) << i;
      EXPECT_TRUE(std::isfinite(scene.body().m_nodes[i].m_v.length())) << i;
    }
    EXPECT_GT(cloth.held(15), 0) << "the others go on";
  }
}

}  // namespace
}  // namespace wetcloth_test::rain_in_world_test
