// SPDX-License-Identifier: Zlib
// Water that strikes a cloth and is not taken in leaves its momentum, as in an inelastic impact, and nothing else.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

#include <array>

namespace wetcloth_test::water_run_off_test {

namespace {

using Vector = std::array<double, 3>;

// A velocity rounded to Bullet's scalar, times a handful of m/s.
constexpr double kTolerance = kIsDouble ? 1e-12 : 1e-5;
const btVector3 kDrops(2, -9, btScalar(0.5));

void strike(wetcloth::Water& water, std::size_t node, double mass) {
  water.runOff(node, mass, double(kDrops.x()), double(kDrops.y()), double(kDrops.z()));
}

void absorb(wetcloth::Water& water, std::size_t node, double mass, const btVector3& v) {
  water.absorb(node, mass, double(v.x()), double(v.y()), double(v.z()));
}

void scatterVelocities(btSoftBody& body) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    if (body.m_nodes[i].m_im == 0) continue;
    body.m_nodes[i].m_v = btVector3(btScalar(0.3 * (i % 5)), btScalar(-1 + 0.2 * (i % 7)), btScalar(0.1 * i));
    body.m_nodes[i].m_vn = body.m_nodes[i].m_v;
  }
}

/// One cloth, only our part of the step, and what happens to its water in it.
struct Struck {
  explicit Struck(WorldKind kind, const wetcloth::ClothPatch& patch = squarePatch(4))
      : scene(kind, patch),
        wet(scene.world(), wetcloth::Hook::manual),
        cloth(exactly(wet.add(scene.body(), fabricOf(2, 1)))) {
    scatterVelocities(scene.body());
  }
  double mass(int node) { return cloth.dryMass(node) + cloth.held(node); }
  btVector3 velocity(int node) { return scene.body().m_nodes[node].m_v; }
  void step(const std::function<void(wetcloth::Water&)>& happens) {
    wetcloth::Effect& effect = addCall(
        cloth, [&](wetcloth::WetCloth& c, const wetcloth::Step&) { happens(c.water()); }, wetcloth::Stage::sources);
    wet.preTick(btScalar(0.01));
    cloth.remove(effect);
  }
  BodyScene scene;
  wetcloth::WetClothWorld wet;
  wetcloth::WetCloth& cloth;
};

TEST_IN_EVERY_WORLD(WaterRunOff, LeavesTheMomentumOfAnInelasticImpact) {
  Struck struck(GetParam());
  struck.cloth.setSaturation(1);
  for (const double share : {1e-6, 0.1, 1.0, 100.0}) {  // of the node's mass
    const btVector3 before = struck.velocity(5);
    const btVector3 elsewhere = struck.velocity(6);
    const double mass = struck.mass(5);
    struck.step([&](wetcloth::Water& water) { strike(water, 5, share * mass); });
    for (int k = 0; k < 3; ++k) {
      const double expected = (double(before[k]) + share * double(kDrops[k])) / (1 + share);
      EXPECT_NEAR(double(struck.velocity(5)[k]), expected, 10 * kTolerance) << share;
    }
    EXPECT_EQ(struck.velocity(6), elsewhere);
    EXPECT_EQ(struck.mass(5), mass);
  }
}

// The water goes away with the node's new velocity, so cloth and water together keep their momentum.
TEST_IN_EVERY_WORLD(WaterRunOff, KeepsTheMomentumOfClothAndWaterTogether) {
  Struck struck(GetParam());
  const btVector3 before = struck.velocity(3);
  const double mass = struck.mass(3);
  const double drops = 0.7 * mass;
  struck.step([&](wetcloth::Water& water) { strike(water, 3, drops); });
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR((mass + drops) * double(struck.velocity(3)[k]), mass * double(before[k]) + drops * double(kDrops[k]),
                10 * mass * kTolerance);
  }
}

TEST_IN_EVERY_WORLD(WaterRunOff, MeetsTheNodeTogetherWithWhatGoesInAndWhatLeaves) {
  Struck struck(GetParam());
  struck.cloth.setSaturation(0.5);
  const double mass = struck.mass(5);
  const btVector3 before = struck.velocity(5);
  const btVector3 river(-1, 0, 4);
  const double in = 0.2 * mass;
  const double off = 0.5 * mass;
  struck.step([&](wetcloth::Water& water) {
    absorb(water, 5, in, river);
    strike(water, 5, off);
    water.drip(5, 0.1 * mass);  // takes the velocity that the impact left
  });
  for (int k = 0; k < 3; ++k) {
    const double momentum = mass * double(before[k]) + in * double(river[k]) + off * double(kDrops[k]);
    EXPECT_NEAR(double(struck.velocity(5)[k]), momentum / (mass + in + off), 10 * kTolerance);
  }
}

TEST_IN_EVERY_WORLD(WaterRunOff, StaysOutOfTheBalanceAndIsCounted) {
  Struck struck(GetParam());
  struck.cloth.setSaturation(0.5);
  const wetcloth::Ledger before = struck.cloth.ledger();
  const double moved = struck.cloth.water().moved();
  const unsigned long long revision = struck.cloth.water().revision();
  const long long commits = struck.cloth.masses().commits();
  struck.step([](wetcloth::Water& water) {
    strike(water, 5, 0.25);
    strike(water, 5, 0.5);
    strike(water, 7, 0.125);
  });
  const wetcloth::Ledger after = struck.cloth.ledger();
  EXPECT_EQ(after.runOff, 0.875);
  EXPECT_EQ(after.initial, before.initial);
  EXPECT_EQ(after.absorbed, 0);
  EXPECT_EQ(after.dripped, 0);
  EXPECT_EQ(after.evaporated, 0);
  EXPECT_EQ(after.held, before.held);
  EXPECT_EQ(after.imbalance(), before.imbalance());
  EXPECT_EQ(struck.cloth.water().moved(), moved);
  EXPECT_EQ(struck.cloth.water().revision(), revision) << "a settled effect sleeps on";
  EXPECT_EQ(struck.cloth.masses().commits(), commits) << "no mass changed, and no link";
  EXPECT_FALSE(struck.cloth.water().movedSinceCommit());
}

TEST_IN_EVERY_WORLD(WaterRunOff, IsForgottenAfterItsStep) {
  Struck struck(GetParam());
  struck.step([](wetcloth::Water& water) { strike(water, 5, 0.25); });
  const btVector3 after = struck.velocity(5);
  struck.step([](wetcloth::Water&) {});
  struck.step([](wetcloth::Water& water) { absorb(water, 2, 0.01, btVector3(0, 0, 0)); });
  EXPECT_EQ(struck.velocity(5), after);
  EXPECT_EQ(struck.cloth.ledger().runOff, 0.25);
}

TEST_IN_EVERY_WORLD(WaterRunOff, OfNothingIsNothing) {
  Struck struck(GetParam());
  const btVector3 before = struck.velocity(5);
  struck.step([](wetcloth::Water& water) {
    strike(water, 5, 0);
    EXPECT_FALSE(water.movedSinceCommit());
  });
  EXPECT_EQ(struck.velocity(5), before);
  EXPECT_EQ(struck.cloth.ledger().runOff, 0);
}

TEST_IN_EVERY_WORLD(WaterRunOff, DoesNotMoveAPinnedNode) {
  wetcloth::ClothPatch patch = squarePatch(4);
  patch.pinnedNodes = {5};
  Struck struck(GetParam(), patch);
  struck.step([](wetcloth::Water& water) { strike(water, 5, 1); });
  EXPECT_EQ(struck.velocity(5), btVector3(0, 0, 0));
  EXPECT_EQ(struck.scene.body().m_nodes[5].m_im, 0);
  EXPECT_EQ(struck.cloth.ledger().runOff, 1);
}

// The deformable world's implicit solve starts from m_vn.
TEST_IN_EVERY_WORLD(WaterRunOff, ReachesBulletsNextStep) {
  BodyScene scene(GetParam(), squarePatch(4), btVector3(0, 0, 0));
  scene.body().setActivationState(DISABLE_DEACTIVATION);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  addCall(
      cloth,
      [](wetcloth::WetCloth& c, const wetcloth::Step&) {
        for (std::size_t i = 0; i < c.water().size(); ++i) {
          c.water().runOff(i, 0.01 * c.dryMass(int(i)), 0, -1, 0);  // the sheet stays flat
        }
      },
      wetcloth::Stage::sources);
  scene.bullet().step(10, btScalar(1) / 256);
  // v' = (v - 0.01) / 1.01 ten times. float32 positions of 1 m over 4 ms: 1e-7 m / 4e-3 s in each step.
  EXPECT_NEAR(double(meanVelocity(scene.body()).y()), -(1 - std::pow(1.01, -10)), kIsDouble ? 1e-7 : 3e-4);
}

}  // namespace
}  // namespace wetcloth_test::water_run_off_test
