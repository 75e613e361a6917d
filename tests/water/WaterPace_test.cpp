// SPDX-License-Identifier: Zlib
// Water at a rate of its own: nothing is lost, nothing is late for long, and what it costs is bounded.

#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>

namespace wetcloth_test::water_pace_test {
namespace {

using wetcloth::Absorption;
using wetcloth::WaterClock;
using wetcloth::WaterPace;

TEST(WaterClock, TurnsAtEverySubstepAreTheSubsteps) {
  WaterClock clock;
  for (const double dt : {0.25, 0.125, 1.0, 0.0625}) {
    const WaterClock::Turn turn = clock.tick(dt, 1);
    EXPECT_EQ(turn.start, 0);
    EXPECT_EQ(turn.dt, dt);
  }
}

// Of five substeps the third is water's, which then has moved by all five: 2 dt before this substep's start, and 2 dt
// beyond its end.
TEST(WaterClock, TheMiddleSubstepStandsForAll) {
  WaterClock clock;
  const double dt = 0.25;
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 5; ++i) {
      const WaterClock::Turn turn = clock.tick(dt, 5);
      EXPECT_EQ(turn.dt, i == 2 ? 5 * dt : 0) << round << ", " << i;
      EXPECT_EQ(turn.start, i == 2 ? -2 * dt : 0) << round << ", " << i;
    }
  }
}

// However substeps and numbers change, steps of water follow each other without a gap and without an overlap.
TEST(WaterClock, StepsOfWaterAdjoinWhateverTheSubsteps) {
  WaterClock clock;
  double now = 0;    // start of the substep
  double water = 0;  // where water's last step ended
  unsigned seed = 1;
  for (int i = 0; i < 1000; ++i) {
    seed = seed * 1664525 + 1013904223;
    const double dt = std::ldexp(1.0, -2 - static_cast<int>(seed >> 30));
    const int n = 1 + static_cast<int>(seed >> 16) % 9;
    const WaterClock::Turn turn = clock.tick(dt, n);
    if (turn.dt > 0) {
      EXPECT_EQ(now + turn.start, water) << i;
      water += turn.dt;
    }
    now += dt;
    EXPECT_LE(std::fabs(now - water), 9 * 0.25 * 2) << i;
  }
}

TEST(WaterPace, IsNoSlowerThanItsLongestStep) {
  const WaterPace pace;
  EXPECT_EQ(pace.substepsOf(1.0 / 240), 5);
  EXPECT_EQ(pace.substepsOf(1.0 / 60), 5);
  EXPECT_EQ(pace.substepsOf(static_cast<double>(1.0f / 30)), 3);
  EXPECT_EQ(pace.substepsOf(1.0 / 16), 1);
  EXPECT_EQ(pace.substepsOf(10), 1);
  EXPECT_EQ(WaterPace::exact().substepsOf(1.0 / 240), 1);
}

TEST_IN_EVERY_WORLD(WaterPaceInWorld, AfterAllSubstepsOfATurnTheLawHolds) {
  ClothScene scene(GetParam(), btVector3(0, 0, 0), squarePatch(5));
  scene.cloth().setPace(WaterPace{});
  scene.cloth().add<Absorption>();
  const int every = WaterPace().everySubsteps;
  scene.step(20 * every, kExactSubstep);
  const double expected = 1 - std::exp(-20 * every * kExactSubstep / scene.cloth().fabric().timeConstant);
  // The closed form that Absorption promises, to rounding of some twenty exponentials.
  EXPECT_NEAR(scene.cloth().saturation(0), expected, 1e-14);
}

TEST_IN_EVERY_WORLD(WaterPaceInWorld, MassesAreWithinTheToleranceAndTheLedgerIsClosed) {
  ClothScene scene(GetParam(), btVector3(0, -10, 0), squarePatch(5));
  WaterPace pace = WaterPace::exact();
  pace.massTolerance = 0.01;
  scene.cloth().setPace(pace);
  scene.cloth().add<Absorption>();
  for (int i = 0; i < 400; ++i) {
    scene.step(1);
    for (int k = 0; k < scene.cloth().nodeCount(); ++k) {
      const double written = 1 / static_cast<double>(scene.body().m_nodes[k].m_im);
      const double true_ = scene.cloth().dryMass(k) + scene.cloth().held(k);
      // What is written was true once and is left alone until it is wrong by the tolerance; float32 rounds it.
      ASSERT_LE(std::fabs(true_ - written), (0.01 + 1e-6) * written) << i;
    }
    ASSERT_NEAR(scene.cloth().ledger().imbalance(), 0, 1e-15);
  }
  // 1.84^(1/n) = 1.01 at n = 61 for all of the water; in 1.67 s a sixth of it comes.
  EXPECT_LT(scene.cloth().masses().commits(), 20);
  EXPECT_GT(scene.cloth().masses().commits(), 5);
}

// Without gravity all momentum is what arrived, whenever it is written.
TEST_IN_EVERY_WORLD(WaterPaceInWorld, MomentumArrivesInFull) {
  ClothScene scene(GetParam(), btVector3(0, 0, 0), squarePatch(5));
  WaterPace pace;
  pace.massTolerance = 0.05;
  scene.cloth().setPace(pace);
  Absorption::Parameters parameters;
  parameters.waterVelocity = btVector3(1, -2, 0.5);
  Absorption& absorption = scene.cloth().add<Absorption>(parameters);
  scene.step(13 * pace.everySubsteps, kExactSubstep);
  parameters.exposure = 0.0;
  absorption.setParameters(parameters);
  scene.step(2 * pace.everySubsteps, kExactSubstep);  // nothing moves now, so that the rest is written
  const double absorbed = scene.cloth().ledger().absorbed;
  btVector3 momentum(0, 0, 0);
  for (int k = 0; k < scene.cloth().nodeCount(); ++k) {
    const btSoftBody::Node& node = scene.body().m_nodes[k];
    momentum += node.m_v / node.m_im;
    EXPECT_FLOAT_EQ(static_cast<float>(1 / node.m_im),
                    static_cast<float>(scene.cloth().dryMass(k) + scene.cloth().held(k)));
  }
  for (int axis = 0; axis < 3; ++axis) {
    // Bullet takes velocities from places a metre from the origin: 6e-8 m over 1/256 s, for each node and step.
    const double rounding = sizeof(btScalar) == 4 ? 5e-3 : 1e-6;
    EXPECT_NEAR(momentum[axis], absorbed * parameters.waterVelocity[axis], rounding * absorbed) << axis;
  }
}

TEST_IN_EVERY_WORLD(WaterPaceInWorld, ASavedStateGoesOnInTheMiddleOfATurn) {
  const auto start = [&](ClothScene& scene) {
    scene.cloth().setPace(WaterPace{});
    scene.cloth().add<Absorption>();
    scene.cloth().add<wetcloth::Drying>();
  };
  ClothScene scene(GetParam(), btVector3(0, -10, 0), squarePatch(5));
  start(scene);
  scene.step(8);
  std::stringstream state;
  scene.wet().save(state);
  scene.step(9);
  ClothScene other(GetParam(), btVector3(0, -10, 0), squarePatch(5));
  start(other);
  other.wet().restore(state);
  other.step(9);
  for (int k = 0; k < scene.cloth().nodeCount(); ++k) {
    EXPECT_EQ(other.cloth().held(k), scene.cloth().held(k)) << k;
    EXPECT_EQ(other.body().m_nodes[k].m_im, scene.body().m_nodes[k].m_im) << k;
    EXPECT_EQ(other.body().m_nodes[k].m_x, scene.body().m_nodes[k].m_x) << k;
  }
}

TEST(WaterPace, BadValuesAreNamedAndChangeNothing) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), squarePatch(3));
  const auto set = [&](int every, double tolerance, double longest = 1) {
    return [&scene, every, tolerance, longest] {
      WaterPace pace;
      pace.longestStep = longest;
      pace.everySubsteps = every;
      pace.massTolerance = tolerance;
      scene.cloth().setPace(pace);
    };
  };
  EXPECT_NE(rejection(set(0, 0)).find("WaterPace.everySubsteps = 0"), std::string::npos);
  EXPECT_NE(rejection(set(1001, 0)).find("WaterPace.everySubsteps = 1001"), std::string::npos);
  EXPECT_NE(rejection(set(1, -1)).find("WaterPace.massTolerance = -1"), std::string::npos);
  EXPECT_NE(rejection(set(1, 0.2)).find("WaterPace.massTolerance = 0.2"), std::string::npos);
  EXPECT_NE(rejection(set(1, std::numeric_limits<double>::quiet_NaN())).find("WaterPace.massTolerance = "),
            std::string::npos);
  EXPECT_NE(rejection(set(1, 0, 0)).find("WaterPace.longestStep = 0"), std::string::npos);
  EXPECT_EQ(scene.cloth().pace().everySubsteps, 1);
  EXPECT_EQ(scene.cloth().pace().massTolerance, 0);
}

}  // namespace
}  // namespace wetcloth_test::water_pace_test
