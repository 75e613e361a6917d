// SPDX-License-Identifier: Zlib
// What the application does to masses while a cloth is wet is respected: a node it pins stays pinned, a mass it sets
// is the node's new dry mass.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"

namespace wetcloth_test::node_masses_test {

namespace {

constexpr double kRounding = kIsDouble ? 1e-14 : 1e-6;

double massOf(btSoftBody& body, int node) { return 1 / double(body.m_nodes[node].m_im); }

TEST_IN_EVERY_WORLD(NodeMasses, AreDryMassPlusWater) {
  BodyScene scene(GetParam(), hangingPatch(5));
  std::vector<double> dry;
  for (int i = 0; i < 25; ++i) dry.push_back(double(scene.body().getMass(i)));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(2, 0.5));
  cloth.add<wetcloth::Absorption>({[](const btVector3& x, const btVector3&) { return double(x.x()); }});
  scene.bullet().step(60);
  for (int i = 0; i < 20; ++i) {  // the last row is pinned
    EXPECT_NEAR(cloth.dryMass(i), dry[std::size_t(i)], kRounding * dry[std::size_t(i)]);
    EXPECT_NEAR(massOf(scene.body(), i), cloth.dryMass(i) + cloth.held(i), kRounding * massOf(scene.body(), i));
  }
  EXPECT_NEAR(cloth.saturation(4), 1 - std::exp(-0.25 / 0.5), 1e-2) << "x = 1";
}

TEST_IN_EVERY_WORLD(NodeMasses, ANodePinnedWhileWetStaysPinnedAndKeepsItsWater) {
  BodyScene scene(GetParam(), squarePatch(4));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(2, 0.5));
  cloth.add<wetcloth::Absorption>();
  scene.bullet().step(30);
  const double dry = cloth.dryMass(5);
  const double held = cloth.held(5);
  scene.body().m_nodes[5].m_im = 0;
  scene.body().m_nodes[5].m_v = btVector3(0, 0, 0);
  scene.body().m_nodes[5].m_vn = btVector3(0, 0, 0);
  const btVector3 place = scene.body().m_nodes[5].m_x;
  scene.bullet().step(60);
  EXPECT_EQ(scene.body().m_nodes[5].m_im, 0);
  EXPECT_LT((scene.body().m_nodes[5].m_x - place).length(), 1e-6);
  EXPECT_EQ(cloth.dryMass(5), dry);
  EXPECT_GT(cloth.held(5), held);
  cloth.setSaturation(0.1);
  EXPECT_EQ(scene.body().m_nodes[5].m_im, 0);
}

TEST_IN_EVERY_WORLD(NodeMasses, AMassSetWhileWetIsTheNewDryMass) {
  BodyScene scene(GetParam(), squarePatch(4));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(2, 0.5));
  cloth.add<wetcloth::Absorption>();
  scene.bullet().step(30);
  const double held = cloth.held(5);
  const double capacity = cloth.capacity(6);
  scene.body().setMass(5, btScalar(0.25));
  scene.bullet().step(1);
  EXPECT_NEAR(cloth.dryMass(5), 0.25, kRounding);
  EXPECT_NEAR(cloth.capacity(5), 0.5, kRounding);
  EXPECT_GE(cloth.held(5), held);
  EXPECT_NEAR(massOf(scene.body(), 5), 0.25 + cloth.held(5), kRounding);
  EXPECT_EQ(cloth.capacity(6), capacity) << "the others are as they were";
  scene.bullet().step(30);
  EXPECT_NEAR(cloth.dryMass(5), 0.25, kRounding) << "taken once";
  EXPECT_NEAR(massOf(scene.body(), 5), 0.25 + cloth.held(5), kRounding);
}

TEST_IN_EVERY_WORLD(NodeMasses, AReleasedNodeTakesTheMassThatItWasGiven) {
  BodyScene scene(GetParam(), hangingPatch(4));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(2, 0.5));
  cloth.add<wetcloth::Absorption>();
  scene.bullet().step(30);
  const int pinned = 13;  // in the top row
  ASSERT_EQ(scene.body().m_nodes[pinned].m_im, 0);
  scene.body().m_nodes[pinned].m_im = btScalar(1 / 0.02);
  scene.bullet().step(2);
  EXPECT_NEAR(cloth.dryMass(pinned), 0.02, kRounding);
  EXPECT_NEAR(massOf(scene.body(), pinned), 0.02 + cloth.held(pinned), kRounding);
  EXPECT_TRUE(isFinite(scene.body()));
}

}  // namespace
}  // namespace wetcloth_test::node_masses_test
