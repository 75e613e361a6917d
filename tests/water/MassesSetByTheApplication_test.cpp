// SPDX-License-Identifier: Zlib
// Masses that the application sets count from the next step on, before any water moves: they are the new dry masses,
// those of pinned nodes follow, and the water stays.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/CallEffect.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace wetcloth_test::masses_set_by_the_application_test {

namespace {

constexpr double kRounding = kIsDouble ? 1e-13 : 2e-6;

class MassesSet {
 protected:
  BodyScene scene{GetParam(), hangingPatch(9)};
  wetcloth::WetClothWorld wet{scene.world()};
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(0.84, 1)));

  double sum(double (wetcloth::WetCloth::*of)(int) const) const {
    double total = 0;
    for (int i = 0; i < cloth.nodeCount(); ++i) total += (cloth.*of)(i);
    return total;
  }
  double freeMass() {
    double total = 0;
    for (int i = 0; i < scene.body().m_nodes.size(); ++i) total += double(scene.body().getMass(i));
    return total;
  }
  void soak() { cloth.add<wetcloth::Absorption>({1.0}); }
};

// An engine's wrapper adds us in its own addSoftBody(), and the game sets the mass after that.
TEST_F_IN_EVERY_WORLD(MassesSet, BeforeTheFirstStepAreTheDryMasses) {
  const double ratio = 1e-5 / freeMass();
  const double pinnedBefore = cloth.dryMass(80);
  soak();
  scene.body().setTotalMass(btScalar(1e-5));
  scene.bullet().step(1);
  EXPECT_NEAR(cloth.dryMass(80), pinnedBefore * ratio, kRounding * pinnedBefore * ratio);
  scene.bullet().step(2400, btScalar(1) / 60);
  EXPECT_NEAR(freeMass(), 1.84e-5, kRounding * 1e-4);
  EXPECT_NEAR(cloth.meanSaturation(), 1, 1e-12);
  for (int i = 0; i < cloth.nodeCount(); ++i) EXPECT_LE(cloth.saturation(i), 1 + 1e-9) << i;
}

// A cloth that was added with the mass that it has, is the measure.
TEST_F_IN_EVERY_WORLD(MassesSet, BeforeTheFirstStepAreAsIfSetBeforeTheCloth) {
  BodyScene other(GetParam(), hangingPatch(9));
  other.body().setTotalMass(btScalar(0.02));
  wetcloth::WetClothWorld otherWet(other.world());
  wetcloth::WetCloth& expected = otherWet.add(other.body(), fabricOf(0.84, 1));
  expected.add<wetcloth::Absorption>({1.0});
  soak();
  scene.body().setTotalMass(btScalar(0.02));
  other.bullet().step(10);
  scene.bullet().step(10);
  for (int i = 0; i < cloth.nodeCount(); ++i) {
    EXPECT_NEAR(cloth.dryMass(i), expected.dryMass(i), kRounding * expected.dryMass(i)) << i;
    EXPECT_NEAR(cloth.held(i), expected.held(i), 10 * kRounding * expected.held(i)) << i;
  }
}

TEST_F_IN_EVERY_WORLD(MassesSet, OnAWetClothLeaveItsWaterAndItsLedger) {
  soak();
  scene.bullet().step(60);
  const double held = cloth.ledger().held;
  const double free = freeMass();
  const double pinned = cloth.dryMass(76);
  scene.body().setTotalMass(btScalar(3 * free));
  const double set = double(scene.body().getMass(40));
  scene.bullet().step(1);
  EXPECT_NEAR(cloth.dryMass(40), set, kRounding * set);
  EXPECT_NEAR(double(scene.body().getMass(40)), set + cloth.held(40), kRounding * set);
  EXPECT_GT(cloth.dryMass(76), 2 * pinned);
  EXPECT_GE(cloth.ledger().held, held);
  EXPECT_LE(std::fabs(cloth.ledger().imbalance()), 1e-12 * held);
}

// Water that is there before the first step stays, on top of the mass that is set.
TEST_F_IN_EVERY_WORLD(MassesSet, BetweenWettingAndTheFirstStepWithoutAnyEffect) {
  cloth.setSaturation(1);
  const double held = cloth.held(3);
  for (int i = 0; i < 72; ++i) scene.body().setMass(i, btScalar(0.01));
  scene.bullet().step(1);
  EXPECT_NEAR(cloth.dryMass(3), 0.01, kRounding * 0.01);
  EXPECT_EQ(cloth.held(3), held);
  EXPECT_NEAR(double(scene.body().getMass(3)), 0.01 + held, kRounding * 0.01);
}

// Nothing tells of these but the masses themselves: all are found within 32 steps, or when one of them is.
TEST_F_IN_EVERY_WORLD(MassesSet, ByHandAreFoundWithin32Steps) {
  cloth.add<wetcloth::Wind>();
  scene.bullet().step(3);
  for (const int node : {0, 37, 71}) {
    scene.body().m_nodes[node].m_im /= 2;
    const double mass = double(scene.body().getMass(node));
    scene.bullet().step(33);
    EXPECT_NEAR(cloth.dryMass(node), mass, kRounding * mass) << node;
  }
}

TEST_F_IN_EVERY_WORLD(MassesSet, ByHandAtAllNodesAreFoundBeforeAnyWaterMoves) {
  soak();
  scene.bullet().step(3);
  for (int i = 0; i < 72; ++i) scene.body().m_nodes[i].m_im *= 1000;
  const double pinned = cloth.dryMass(80);
  double most = 0;
  addCall(
      cloth, [&](wetcloth::WetCloth& c, const wetcloth::Step&) { most = std::max(most, c.capacity(40)); },
      wetcloth::Stage::sources);
  scene.bullet().step(1);
  EXPECT_NEAR(most, 0.84 * cloth.dryMass(40), 1e-12 * most);
  EXPECT_LT(cloth.dryMass(80), pinned / 100);
}

TEST_F_IN_EVERY_WORLD(MassesSet, BeforeAnEffectIsAddedAreWhatItSees) {
  scene.bullet().step(3);
  for (int i = 0; i < 72; ++i) scene.body().m_nodes[i].m_im /= 2;
  soak();
  EXPECT_NEAR(cloth.dryMass(3), double(scene.body().getMass(3)), kRounding * cloth.dryMass(3));
}

// A mass that is none changes nothing that we know, and heals with the next commit.
TEST_F_IN_EVERY_WORLD(MassesSet, ThatAreNoMassesAreNotTakenOver) {
  soak();
  scene.bullet().step(3);
  const double dry = cloth.dryMass(5);
  for (const btScalar bad :
       {std::numeric_limits<btScalar>::infinity(), std::numeric_limits<btScalar>::quiet_NaN(), btScalar(-1)}) {
    scene.body().m_nodes[5].m_im = bad;
    wet.preTick(btScalar(0.01));
    EXPECT_EQ(cloth.dryMass(5), dry) << bad;
    EXPECT_TRUE(std::isfinite(cloth.held(5))) << bad;
    EXPECT_TRUE(std::isfinite(cloth.dryMass(80)) && cloth.dryMass(80) > 0) << bad;
  }
}

}  // namespace
}  // namespace wetcloth_test::masses_set_by_the_application_test
