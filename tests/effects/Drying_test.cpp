// SPDX-License-Identifier: Zlib
// A cloth that dries: the closed form for one step or many, climate, wind, exposure.

#include "bullet_wetcloth/effects/Drying.h"

#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"

#include <cmath>
#include <vector>

namespace wetcloth_test::drying_test {
namespace {

using wetcloth::Drying;
using wetcloth::dryingStep;
using wetcloth::dryingTime;
using wetcloth::evaporationRate;
using wetcloth::Fabric;
using wetcloth::Hook;

/// The closed forms below are those of a cloth that does not cool itself.
Drying::Parameters asWarmAsTheAir(Drying::Parameters parameters) {
  parameters.selfCooling = 1;
  return parameters;
}

/// A saturated 3 x 3 cloth of 1 m^2; only our part of the step runs. Node 4, in the middle, has a quarter of its area.
struct Line {
  explicit Line(Drying::Parameters parameters = {})
      : scene(WorldKind::softRigid, kEarthGravity, levelPatch(3, 1), Fabric::cotton(), Hook::manual),
        effect(scene.cloth().add<Drying>(asWarmAsTheAir(std::move(parameters)))) {
    scene.cloth().setSaturation(1);
  }
  double held(int node = 4) { return scene.cloth().held(node); }
  double capacity(int node = 4) { return scene.cloth().capacity(node); }
  ClothScene scene;
  Drying& effect;
};

constexpr double kArea = 0.25;  // [m^2] of node 4

/// 2 sides at 20 degrees, 50 % [kg/s].
double rate(double airSpeed = 0, double humidity = 0.5, double temperature = 20) {
  return 2 * kArea * evaporationRate(temperature, humidity, airSpeed);
}

// The patch's area and mass are sums of btScalar lengths and masses.
constexpr double kGeometry = kIsDouble ? 1e-12 : 1e-6;

// --- the closed form --------------------------------------------------------------------------------------------

// Cotton holds 126 g/m^2: 1240 s at the constant rate down to 0.3, then exponential with 531 s.
TEST(Drying, FollowsTheClosedFormWhateverTheStep) {
  for (const double time : {1000.0, 1280.0, 2000.0, 5000.0}) {
    for (const int steps : {1, 7, 100, 10000}) {
      Line line;
      const double dt = double(btScalar(time / steps));  // what the float32 build is really told
      for (int i = 0; i < steps; ++i) line.scene.preTick(dt);
      const double expected = line.capacity() - dryingStep(line.capacity(), 0.3 * line.capacity(), rate(), steps * dt);
      EXPECT_NEAR(line.held() / expected, 1, 10 * kGeometry) << time << " s in " << steps;
    }
  }
}

// What is above it dries as if it were all there is.
TEST(Drying, LeavesWhatTheFibresKeepInTheAir) {
  for (const int steps : {1, 100}) {
    Drying::Parameters parameters;
    parameters.equilibriumSaturation = 0.1;
    Line line(parameters);
    const double kept = 0.1 * line.capacity();
    for (const double time : {1000.0, 4000.0}) {
      const double before = line.held() - kept;
      const double dt = double(btScalar(time / steps));
      for (int i = 0; i < steps; ++i) line.scene.preTick(dt);
      const double left = before - dryingStep(before, 0.2 * line.capacity(), rate(), steps * dt);
      EXPECT_NEAR(line.held() / (kept + left), 1, 10 * kGeometry) << time << " s in " << steps;
    }
    for (int i = 0; i < 100; ++i) line.scene.preTick(1e4);
    EXPECT_NEAR(line.held() / kept, 1, 1e-12);
    const double atRest = line.held();
    line.scene.preTick(1e4);
    EXPECT_EQ(line.held(), atRest);
  }
}

// Drier cloth takes nothing from the air: that is for Absorption.
TEST(Drying, TakesNothingFromClothThatIsDrierThanTheAirKeepsIt) {
  Drying::Parameters parameters;
  parameters.equilibriumSaturation = 0.2;
  Line line(parameters);
  line.scene.cloth().setSaturation(0.1);
  const double before = line.held();
  line.scene.preTick(1000);
  EXPECT_EQ(line.held(), before);
}

TEST(Drying, TakesTheDryingTimeOfTheClosedForm) {
  Line line;
  const double dt = 0.5;
  double time = 0;
  while (line.held() > 0.05 * line.capacity() && time < 1e4) {
    line.scene.preTick(dt);
    time += dt;
  }
  EXPECT_NEAR(time, dryingTime(line.capacity(), 0.05 * line.capacity(), 0.3 * line.capacity(), rate()), dt);
}

// At the constant rate what dries is the integral of the rate: the middle of each step has it exactly where it grows
// evenly, and to second order otherwise.
TEST(Drying, LooksAtWhatChangesInTimeInTheMiddleOfTheStep) {
  const auto dried = [](Drying::Parameters parameters, int steps) {
    Line line(std::move(parameters));
    for (int i = 0; i < steps; ++i) line.scene.preTick(512.0 / steps);
    return line.capacity() - line.held();
  };
  Drying::Parameters covered;
  covered.exposure = [](const btVector3&, const btVector3&, double time) { return time / 512; };
  for (const int steps : {1, 4, 64}) EXPECT_NEAR(dried(covered, steps) / (rate() * 256), 1, 10 * kGeometry) << steps;
  Drying::Parameters windy;
  windy.air = [](const btVector3&, double time) { return btVector3(btScalar(time * time / 65536), 0, 0); };
  const double converged = dried(windy, 4096);
  EXPECT_NEAR(dried(windy, 1) / (rate(1) * 512), 1, 10 * kGeometry);
  EXPECT_NEAR((dried(windy, 8) - converged) / (dried(windy, 16) - converged), 4, 0.5);
}

// Equal portions of a constant rate are rounded the same way each time: the carry keeps a million of them exact.
TEST(Drying, ManyEqualPortionsAreNotLostToRounding) {
  Line line;
  const double dt = 1.0 / 4096;
  for (int i = 0; i < 1 << 18; ++i) line.scene.preTick(dt);  // 64 s
  const double dried = line.scene.cloth().ledger().evaporated / (2 * evaporationRate(20, 0.5, 0));
  EXPECT_NEAR(dried / 64, 1, kGeometry);
  Line once;
  once.scene.preTick(64);
  EXPECT_NEAR(line.held() / once.held(), 1, 1e-14) << "the same to the last digits, in one step or 262144";
}

TEST(Drying, StaysWithinBoundsForAnyStep) {
  for (const double dt : {1e-6, 1.0 / 240, 1.0, 600.0, 1e6}) {
    Line line;
    double before = line.held();
    for (int i = 0; i < 100; ++i) {
      line.scene.preTick(dt);
      ASSERT_GE(line.held(), 0) << dt;
      ASSERT_LE(line.held(), before) << dt;
      before = line.held();
    }
    const wetcloth::Ledger ledger = line.scene.cloth().ledger();
    EXPECT_GT(ledger.evaporated, 0) << dt;
    EXPECT_LE(std::fabs(ledger.imbalance()), 1e-12 * ledger.initial) << dt;
  }
}

TEST(Drying, OfAnOverfullNodeIsTheSameLaw) {
  Line line;
  line.scene.cloth().setHeld(std::vector<double>(9, 2 * line.capacity()));
  line.scene.preTick(3600);
  const double expected = 2 * line.capacity() - dryingStep(2 * line.capacity(), 0.3 * line.capacity(), rate(), 3600);
  EXPECT_NEAR(line.held() / expected, 1, 10 * kGeometry);
}

// The whole cloth loses what its whole area gives, though a corner has less area than an inner node.
TEST(Drying, IsByArea) {
  Line line;
  line.scene.preTick(100);
  EXPECT_NEAR(line.scene.cloth().ledger().evaporated / (200 * evaporationRate(20, 0.5, 0)), 1, kGeometry);
}

// --- climate, wind, exposure ------------------------------------------------------------------------------------

double driedIn100Seconds(Line& line) {
  const double before = line.held();
  line.scene.preTick(100);
  return before - line.held();
}

TEST(Drying, FollowsTheClimate) {
  Line line;
  adjust(line.effect, [](auto& p) {
    p.temperature = 35;
    p.relativeHumidity = 0.25;
  });
  EXPECT_NEAR(driedIn100Seconds(line) / (100 * rate(0, 0.25, 35)), 1, kGeometry);
  adjust(line.effect, [](auto& p) {
    p.temperature = 20;
    p.relativeHumidity = 1;
  });
  EXPECT_EQ(driedIn100Seconds(line), 0);
}

TEST(Drying, InWindIsFasterAsTheFormulaSays) {
  Line line;
  adjust(line.effect, [](auto& p) { p.air = btVector3(3, 0, 4); });
  EXPECT_NEAR(driedIn100Seconds(line) / (100 * rate(5)), 1, kGeometry);
  adjust(line.effect,
         [](auto& p) { p.air = [](const btVector3&, double time) { return btVector3(btScalar(time / 50), 0, 0); }; });
  EXPECT_NEAR(driedIn100Seconds(line) / (100 * rate(3)), 1, kGeometry) << "in the middle of the step, 150 s";
}

TEST(Drying, CountsTheAirsSpeedRelativeToTheCloth) {
  Line line;
  adjust(line.effect, [](auto& p) { p.air = btVector3(3, 0, 0); });
  setVelocity(line.scene.body(), btVector3(3, 0, 0));
  EXPECT_NEAR(driedIn100Seconds(line) / (100 * rate(0)), 1, kGeometry);
  setVelocity(line.scene.body(), btVector3(-1, 0, 0));
  EXPECT_NEAR(driedIn100Seconds(line) / (100 * rate(4)), 1, kGeometry);
}

TEST(Drying, OfOneSideIsHalfAsFast) {
  Drying::Parameters parameters;
  parameters.sides = 1;
  Line line(parameters);
  EXPECT_NEAR(driedIn100Seconds(line) / (50 * rate()), 1, kGeometry);
}

TEST(Drying, FollowsTheExposure) {
  Line line;
  adjust(line.effect, [](auto& p) { p.exposure = 0.25; });
  EXPECT_NEAR(driedIn100Seconds(line) / (25 * rate()), 1, kGeometry);
  std::vector<double> perNode(9, 0.0);
  perNode[4] = 0.5;
  adjust(line.effect, [&](auto& p) { p.exposure = perNode; });
  const double other = line.held(0);
  EXPECT_NEAR(driedIn100Seconds(line) / (50 * rate()), 1, kGeometry);
  EXPECT_EQ(line.held(0), other);
  adjust(line.effect, [](auto& p) {
    p.exposure = [](const btVector3&, const btVector3& normal) { return std::fabs(double(normal.y())); };
  });
  EXPECT_NEAR(driedIn100Seconds(line) / (100 * rate()), 1, 1e-5);  // a normal is of length 1 to some 1e-6 in float32
}

TEST(Drying, LeavesTheVelocities) {
  Line line;
  const btVector3 velocity(2, -1, btScalar(0.5));
  setVelocity(line.scene.body(), velocity);
  line.scene.preTick(600);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(line.scene.node(i).m_v, velocity);
  EXPECT_NEAR(double(line.scene.node(4).m_im) * line.scene.cloth().water().totalMass(4), 1, kGeometry);
}

// --- in Bullet's worlds -----------------------------------------------------------------------------------------

TEST_IN_EVERY_WORLD(DryingInWorld, OfAPinnedClothFollowsTheClosedForm) {
  wetcloth::ClothPatch patch = levelPatch(3, 1);
  patch.pinnedNodes = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  Drying::Parameters parameters;
  parameters.air = btVector3(5, 0, 0);
  ClothScene scene(GetParam(), kEarthGravity, patch);
  scene.cloth().add<Drying>(asWarmAsTheAir(parameters));
  scene.cloth().setSaturation(1);
  scene.step(512, kExactSubstep);
  const double capacity = scene.cloth().capacity(4);
  const double dried = dryingStep(capacity, 0.3 * capacity, rate(5), 2);
  EXPECT_NEAR((capacity - scene.cloth().held(4)) / dried, 1, kGeometry);
}

}  // namespace
}  // namespace wetcloth_test::drying_test
