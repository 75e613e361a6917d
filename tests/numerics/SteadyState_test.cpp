// SPDX-License-Identifier: Zlib
// When an effect that moves water may idle, and what makes it go on.

#include "bullet_wetcloth/numerics/SteadyState.h"
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wetcloth_test::steady_state_test {

namespace {

using wetcloth::SteadyState;
using wetcloth::Step;

constexpr int kPatience = 64;  // quiet steps, as the header says
constexpr int kLooks = 32;     // steps in which each node is looked at once

/// A cloth of 10 x 10 nodes, 1 m x 1 m, and an effect that moves as much as it is told.
struct Resting {
  explicit Resting(SteadyState::DependsOn inputs)
      : scene(WorldKind::softRigid, squarePatch(10)),
        wet(scene.world(), wetcloth::Hook::manual),
        cloth(wet.add(scene.body(), fabricOf(1, 1))),
        steadyState(inputs) {}
  double capacity() { return cloth.water().totalCapacity(); }
  /// One step of the effect; true when it was left out.
  bool step(double moved) {
    if (steadyState.isReached(cloth.body(), cloth.water(), now.gravity)) return true;
    steadyState.note(cloth.body(), cloth.water(), now.gravity, now.dt, moved);
    return false;
  }
  /// Quiet steps until one is left out.
  int stepsUntilSettled() {
    int steps = 0;
    while (!step(0) && steps < 1000) ++steps;
    return steps;
  }
  /// Steps that are left out before one is not, at most `most`.
  int stepsUntilAwake(int most) {
    int steps = 0;
    while (steps < most && steadyState.isReached(cloth.body(), cloth.water(), now.gravity)) ++steps;
    return steps;
  }
  BodyScene scene;
  wetcloth::WetClothWorld wet;
  wetcloth::WetCloth& cloth;
  SteadyState steadyState;
  Step now{1.0 / 240, 0, kEarthGravity};
};

using SettlingOnEither = testing::TestWithParam<SteadyState::DependsOn>;

TEST_P(SettlingOnEither, AfterSixtyFourQuietSteps) {
  Resting resting(GetParam());
  EXPECT_EQ(resting.stepsUntilSettled(), kPatience);
  EXPECT_EQ(resting.stepsUntilAwake(1000), 1000);
}

TEST_P(SettlingOnEither, QuietIsABillionthOfTheCapacityASecond) {
  Resting resting(GetParam());
  const double billionth = 1e-9 * resting.capacity() * resting.now.dt;
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(resting.step(1.01 * billionth)) << i;
  for (int i = 0; i < kPatience; ++i) EXPECT_FALSE(resting.step(0.99 * billionth)) << i;
  EXPECT_TRUE(resting.step(0));
}

TEST_P(SettlingOnEither, TheQuietStepsMustBeOnEnd) {
  Resting resting(GetParam());
  for (int i = 0; i < kPatience - 1; ++i) EXPECT_FALSE(resting.step(0));
  EXPECT_FALSE(resting.step(1e-6 * resting.capacity()));
  EXPECT_EQ(resting.stepsUntilSettled(), kPatience);
}

TEST_P(SettlingOnEither, WhatIsNoNumberIsNotQuiet) {
  Resting resting(GetParam());
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(resting.step(std::nan(""))) << i;
}

TEST_P(SettlingOnEither, GoesOnAfterRestart) {
  Resting resting(GetParam());
  resting.stepsUntilSettled();
  resting.steadyState.restart();
  EXPECT_EQ(resting.stepsUntilSettled(), kPatience);
}

TEST_P(SettlingOnEither, GoesOnWhenWaterComesGoesOrMoves) {
  wetcloth::WetCloth* wetted = nullptr;
  const std::function<void(double)> ways[] = {
      [&](double mass) { wetted->water().absorb(5, mass, 0, 0, 0); },
      [&](double mass) { wetted->water().drip(5, mass); },
      [&](double mass) { wetted->water().evaporate(5, mass); },
      [&](double mass) { wetted->water().move(5, 6, mass, 0, 0, 0); },
      [&](double mass) {
        std::vector<double> held;
        for (int i = 0; i < wetted->nodeCount(); ++i) held.push_back(wetted->held(i));
        held[5] -= mass;
        held[6] += mass;
        wetted->water().redistribute(held);
      },
      [&](double mass) {
        std::vector<double> held;
        for (int i = 0; i < wetted->nodeCount(); ++i) held.push_back(wetted->held(i));
        held[5] += mass;
        wetted->setHeld(held);
      },
  };
  int way = 0;
  for (const auto& change : ways) {
    Resting resting(GetParam());
    wetted = &resting.cloth;
    resting.cloth.setSaturation(0.5);
    resting.stepsUntilSettled();
    // A hundred steps of another effect that is itself about to settle.
    for (int i = 0; i < 90; ++i) {
      change(1e-9 * resting.capacity());
      EXPECT_TRUE(resting.step(0)) << "way " << way << ", step " << i;
    }
    change(2e-8 * resting.capacity());
    EXPECT_FALSE(resting.step(0)) << "way " << way;
    ++way;
  }
}

TEST_P(SettlingOnEither, RunOffDisturbsNobody) {
  Resting resting(GetParam());
  resting.stepsUntilSettled();
  resting.cloth.water().runOff(5, 1, 0, 0, 0);
  EXPECT_TRUE(resting.step(0));
}

// What it moved itself before it settled does not count.
TEST_P(SettlingOnEither, ItsOwnWaterDoesNotKeepItAwake) {
  Resting resting(GetParam());
  resting.cloth.water().absorb(5, 0.1 * resting.capacity(), 0, 0, 0);
  EXPECT_FALSE(resting.step(0.1 * resting.capacity()));
  EXPECT_EQ(resting.stepsUntilSettled(), kPatience);
  EXPECT_EQ(resting.stepsUntilAwake(100), 100);
}

INSTANTIATE_TEST_SUITE_P(, SettlingOnEither,
                         testing::Values(SteadyState::DependsOn::water, SteadyState::DependsOn::waterAndShape),
                         [](const auto& test) {
                           return test.param == SteadyState::DependsOn::water ? "water" : "waterAndShape";
                         });

class SettlingOnShape : public testing::Test {
 protected:
  SettlingOnShape() : resting(SteadyState::DependsOn::waterAndShape) { resting.stepsUntilSettled(); }
  Resting resting;
};

// A thousandth of the body's size: bounds of 1 m x 1 m and Bullet's margin of 0.25 m on each side, 2.2 m.
TEST_F(SettlingOnShape, GoesOnAtOnceWhenTheWholeClothMoved) {
  for (int i = 0; i < 100; ++i) resting.scene.body().m_nodes[i].m_x += btVector3(0, btScalar(-0.01), 0);
  EXPECT_EQ(resting.stepsUntilAwake(100), 0);
}

TEST_F(SettlingOnShape, GoesOnWithinThirtyTwoStepsWhenOneNodeMoved) {
  int latest = 0;
  for (const int node : {0, 13, 50, 99}) {
    resting.stepsUntilSettled();
    resting.scene.body().m_nodes[node].m_x += btVector3(0, 0, btScalar(0.01));
    const int steps = resting.stepsUntilAwake(1000);
    EXPECT_LT(steps, kLooks) << node;
    latest = std::max(latest, steps);
  }
  EXPECT_GT(latest, 0) << "not all nodes are looked at in each step";
}

TEST_F(SettlingOnShape, SleepsOnThroughSmallMotion) {
  for (int i = 0; i < 100; ++i) resting.scene.body().m_nodes[i].m_x += btVector3(0, btScalar(-0.001), 0);
  EXPECT_EQ(resting.stepsUntilAwake(100), 100);
  // Creep adds up: it is the shape when it settled that counts.
  int creeps = 0;
  while (creeps < 100 && resting.step(0)) {
    ++creeps;
    for (int i = 0; i < 100; ++i) resting.scene.body().m_nodes[i].m_x += btVector3(0, btScalar(-0.0005), 0);
  }
  EXPECT_LT(creeps, 10);
}

TEST_F(SettlingOnShape, GoesOnWhenGravityChanges) {
  resting.now.gravity = btVector3(0, btScalar(-1.62), 0);
  EXPECT_FALSE(resting.step(0));
  EXPECT_EQ(resting.stepsUntilSettled(), kPatience - 1);
}

TEST_F(SettlingOnShape, GoesOnWhenTheBodyHasMoreNodes) {
  btSoftBody& body = resting.scene.body();
  resting.wet.setLog([](const std::string&) {});
  ASSERT_TRUE(body.cutLink(body.m_faces[0].m_n[0], body.m_faces[0].m_n[1], btScalar(0.5)));
  resting.cloth.setSaturation(0);  // the cloth adapts
  EXPECT_FALSE(resting.step(0));
  EXPECT_EQ(resting.stepsUntilSettled(), kPatience - 1);
  EXPECT_EQ(resting.stepsUntilAwake(100), 100);
}

TEST(SettlingOnWater, DoesNotLookAtTheShape) {
  Resting resting(SteadyState::DependsOn::water);
  resting.stepsUntilSettled();
  for (int i = 0; i < 100; ++i) resting.scene.body().m_nodes[i].m_x += btVector3(5, 5, 5);
  resting.now.gravity = btVector3(0, 0, 0);
  EXPECT_EQ(resting.stepsUntilAwake(100), 100);
}

}  // namespace
}  // namespace wetcloth_test::steady_state_test
