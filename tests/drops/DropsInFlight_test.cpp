// SPDX-License-Identifier: Zlib
// How drops fly: against closed forms.

#include "tests/drops/DropsScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wetcloth_test::drops_in_flight_test {
namespace {

using namespace drops_scene;
using wetcloth::Drops;
using wetcloth::Pour;

// Positions are told in Bullet's scalar: 6e-8 of some metres in float32.
constexpr double kTold = kIsDouble ? 1e-12 : 1e-5;

// Drops are one substep behind: where they are belongs to the time at the beginning of the last substep.
double timeOf(int steps) { return (steps - 1) * kSubstep; }

TEST(DropsInFlight, AStreamIsAParabolaInAVacuum) {
  Drops::Parameters parameters;
  parameters.air = vacuum();
  DropsScene scene(parameters);
  Pour pour;
  pour.position = btVector3(3, 2, 0);
  pour.velocity = btVector3(4, 3, 0);
  pour.flow = 0.1;
  scene.drops.add(pour);
  scene.step(100);
  ASSERT_GT(scene.drops.size(), 100u);
  for (std::size_t i = 0; i < scene.drops.size(); ++i) {
    const wetcloth::Drop drop = scene.drops[i];
    const double age = (double(drop.position.x()) - 3) / 4;
    EXPECT_NEAR(double(drop.position.y()), 2 + 3 * age - 9.81 * age * age / 2, kTold);
    EXPECT_NEAR(double(drop.velocity.y()), 3 - 9.81 * age, kTold);
  }
  // All that has come, but for less than a drop.
  const double poured = pour.flow * timeOf(100);
  EXPECT_LE(scene.drops.ledger().inFlight, poured * (1 + 1e-12));
  EXPECT_GE(scene.drops.ledger().inFlight, poured - 1.01 * scene.drops[0].mass);
}

// With Stokes' drag alone, u = v_t (1 - exp(-k t)) and x = v_t (t - (1 - exp(-k t)) / k), v_t = g / k.
TEST(DropsInFlight, ATinyDropFallsByStokesLaw) {
  Drops::Parameters parameters;
  parameters.air.density = 0;  // so that Re = 0
  DropsScene scene(parameters);
  scene.drops.add(oneDrop(btVector3(3, 2, 0), btVector3(0, 0, 0), 1e-4));
  const double decay = wetcloth::dropDecay(1e-4, 0, parameters.air);
  for (const int steps : {2, 10, 100, 300}) {
    DropsScene run(parameters);
    run.drops.add(oneDrop(btVector3(3, 2, 0), btVector3(0, 0, 0), 1e-4));
    run.step(steps);
    ASSERT_EQ(run.drops.size(), 1u);
    const double time = timeOf(steps);
    const double share = -std::expm1(-decay * time);
    EXPECT_NEAR(double(run.drops[0].velocity.y()), -9.81 / decay * share, 1e-7);
    EXPECT_NEAR(double(run.drops[0].position.y()), 2 - 9.81 / decay * (time - share / decay), 1e-6);
  }
}

// Where drag is quadratic, u = v_t tanh(g t / v_t): a large drop of stiff water, from some m/s on.
TEST(DropsInFlight, ALargeStiffDropFallsByQuadraticDrag) {
  Drops::Parameters parameters;
  parameters.air.viscosity = 0;         // Re is infinite, the coefficient 0.44
  parameters.air.surfaceTension = 1e9;  // and it stays a sphere
  parameters.longestFlight = 100;
  const double terminal = wetcloth::terminalSpeed(5e-3, 9.81, parameters.air);
  double last = 0;
  for (const double dt : {1.0 / 60, 1.0 / 120, 1.0 / 240}) {
    DropsScene scene(parameters);
    scene.drops.add(oneDrop(btVector3(3, 100, 0), btVector3(0, 0, 0), 5e-3));
    const int steps = int(std::lround(1 / dt)) + 1;
    scene.step(steps, dt);
    const double error = std::fabs(-double(scene.drops[0].velocity.y()) - terminal * std::tanh(9.81 / terminal));
    // The rate is held in each step: an error of first order, so it halves. At 240 Hz it is below a tenth of a per
    // cent.
    if (last > 0) {
      EXPECT_NEAR(last / error, 2, 0.2);
    }
    last = error;
  }
  EXPECT_LT(last, 2e-3 * terminal);
}

TEST(DropsInFlight, EndsAtItsTerminalVelocityAndDriftsWithTheWind) {
  Drops::Parameters parameters;
  parameters.wind = btVector3(3, 0, -2);
  DropsScene scene(parameters);
  scene.drops.add(oneDrop(btVector3(3, 100, 0), btVector3(0, 0, 0), 1e-3));
  scene.step(240 * 5);
  const btVector3 velocity = scene.drops[0].velocity;
  // After twelve time constants; exact in the limit, whatever the step.
  EXPECT_NEAR(double(velocity.y()), -wetcloth::terminalSpeed(1e-3, 9.81, parameters.air), 1e-4);
  EXPECT_NEAR(double(velocity.x()), 3, 1e-4);
  EXPECT_NEAR(double(velocity.z()), -2, 1e-4);
}

TEST(DropsInFlight, AWindThatIsAFunctionIsAskedWhereTheDropIs) {
  Drops::Parameters parameters;
  parameters.wind = wetcloth::WindField(
      [](const btVector3& x, double) { return x.y() > 1 ? btVector3(0, 0, 5) : btVector3(0, 0, btScalar(kNaN)); });
  DropsScene scene(parameters);
  scene.drops.add(oneDrop(btVector3(3, 2, 0), btVector3(0, 0, 0)));
  scene.step(60);
  EXPECT_GT(double(scene.drops[0].velocity.z()), 0);
  scene.step(120);
  EXPECT_TRUE(std::isfinite(double(scene.drops[0].velocity.z())));
}

TEST(DropsInFlight, TheNearestMergeWhenThereAreTooMany) {
  Drops::Parameters parameters;
  parameters.air = vacuum();
  parameters.mostDrops = 7;
  DropsScene scene(parameters, pinned(3), kNoGravity);
  Pour pour;
  pour.position = btVector3(3, 2, 0);
  pour.velocity = btVector3(1, 0, 0);
  pour.flow = 0.1;
  scene.drops.add(pour);
  scene.step(240);
  EXPECT_EQ(scene.drops.size(), 7u);
  EXPECT_GT(scene.drops.merged(), 100);
  double mass = 0, momentum = 0;
  for (std::size_t i = 0; i < scene.drops.size(); ++i) {
    mass += scene.drops[i].mass;
    momentum += scene.drops[i].mass * double(scene.drops[i].velocity.x());
  }
  const wetcloth::WorldLedger ledger = scene.drops.ledger();
  EXPECT_NEAR(mass, ledger.brought, kLedger * ledger.brought);
  EXPECT_NEAR(momentum, ledger.brought * 1, kTold * ledger.brought);
  EXPECT_NEAR(ledger.imbalance(), 0, kLedger * ledger.brought);
}

TEST(DropsInFlight, FewerAreAllowedLater) {
  DropsScene scene;
  Pour pour;
  pour.position = btVector3(3, 2, 0);
  scene.drops.add(pour);
  scene.step(60);
  const double before = scene.drops.ledger().inFlight;
  Drops::Parameters fewer;
  fewer.mostDrops = 3;
  scene.drops.setParameters(fewer);
  EXPECT_EQ(scene.drops.size(), 3u);
  EXPECT_NEAR(scene.drops.ledger().inFlight, before, kLedger * before);
}

TEST(DropsInFlight, LeaveTheWorldAfterTheirLongestFlight) {
  Drops::Parameters parameters;
  parameters.longestFlight = 0.5;
  DropsScene scene(parameters);
  scene.drops.add(oneDrop(btVector3(3, 2, 0), btVector3(0, 0, 0)));
  scene.step(119);
  EXPECT_EQ(scene.drops.size(), 1u);
  scene.step(10);
  EXPECT_EQ(scene.drops.size(), 0u);
  EXPECT_EQ(scene.drops.ledger().left, scene.drops.ledger().brought);
}

TEST(DropsInFlight, ASpoutMovesAndStops) {
  DropsScene scene;
  Pour pour;
  pour.velocity = btVector3(0, 0, 0);
  pour.start = 0.1;
  pour.stop = 0.3;
  pour.flow = 0.05;
  pour.move = [](Pour& spout, double time) { spout.position = btVector3(btScalar(10 * time), 2, 0); };
  scene.drops.add(pour);
  scene.step(240);
  // A drop more or less.
  EXPECT_NEAR(scene.drops.ledger().brought, 0.05 * 0.2, 4e-5);
  double low = 1e9, high = -1e9;
  for (std::size_t i = 0; i < scene.drops.size(); ++i) {
    low = std::min(low, double(scene.drops[i].position.x()));
    high = std::max(high, double(scene.drops[i].position.x()));
  }
  // The first and the last drop, of 0.7 ms each, and half a substep.
  EXPECT_NEAR(low, 1, 0.05);
  EXPECT_NEAR(high, 3, 0.05);
}

TEST(DropsInFlight, AGlassGivesWhatIsOverItsRim) {
  DropsScene scene;
  wetcloth::Glass glass;
  glass.water = 0.2;
  glass.pose = [](double time) {
    const btScalar angle = btScalar(-std::min(1.0, time) * 1.0);  // [rad]
    return btTransform(btQuaternion(btVector3(0, 0, 1), angle), btVector3(3, 2, 0));
  };
  scene.drops.add(glass);
  scene.step(240 * 3);
  const double held =
      wetcloth::DropAir().waterDensity * wetcloth::heldInTiltedGlass(glass.radius, glass.height, std::cos(1.0));
  // Forty time constants after it came to rest; a drop less or more.
  EXPECT_NEAR(scene.drops.waterIn(0), held, 7e-5);
  EXPECT_NEAR(scene.drops.ledger().brought, 0.2 - held, 7e-5);
  // It tips towards x, and so does the water run.
  EXPECT_GT(scene.drops.size(), 0u);
  for (std::size_t i = 0; i < scene.drops.size(); ++i) EXPECT_GT(double(scene.drops[i].position.x()), 3.05);
}

// More than anybody tells apart comes in larger drops.
TEST(DropsInFlight, AFlowWithoutMeasureEndsTheStepAllTheSame) {
  DropsScene scene;
  Pour pour;
  pour.position = btVector3(3, 2, 0);
  pour.flow = 1e9;
  scene.drops.add(pour);
  scene.step(3);
  const wetcloth::WorldLedger ledger = scene.drops.ledger();
  EXPECT_NEAR(ledger.brought, 1e9 * 2 * kSubstep, 1e-7 * ledger.brought);  // of a step that is a float
  EXPECT_NEAR(ledger.imbalance(), 0, kLedger * ledger.brought);
}

TEST(DropsInFlight, WhatAFunctionThrowsEndsTheSpoutWithAMessage) {
  DropsScene scene;
  std::string said;
  scene.scene().wet().setLog([&](const std::string& message) { said += message; });
  Pour pour;
  pour.position = btVector3(3, 2, 0);
  pour.move = [](Pour&, double) { throw std::runtime_error("no more"); };
  scene.drops.add(pour);
  scene.step(10);
  EXPECT_NE(said.find("no more"), std::string::npos);
  EXPECT_EQ(scene.drops.size(), 0u);
}

}  // namespace
}  // namespace wetcloth_test::drops_in_flight_test
