// SPDX-License-Identifier: Zlib
// Where a cloth is in contact with water: a constant, an array, a function of position and normal; and when the
// effect has nothing to do.

#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace wetcloth_test::absorption_exposure_test {
namespace {

using wetcloth::Absorption;
using wetcloth::Exposure;
using wetcloth::Fabric;
using wetcloth::Hook;

constexpr double kTheta = 8.844;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double soaked(double time, double exposure) { return -std::expm1(-exposure * time / kTheta); }

struct Bath {
  explicit Bath(Exposure exposure)
      : scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(5, 1), Fabric::cotton(), Hook::manual),
        effect(scene.cloth().add<Absorption>(parametersOf(std::move(exposure)))) {}
  static Absorption::Parameters parametersOf(Exposure exposure) {
    Absorption::Parameters parameters;
    parameters.exposure = std::move(exposure);
    return parameters;
  }
  ClothScene scene;
  Absorption& effect;
};

TEST(AbsorptionExposure, ArrayGivesEachNodeItsOwn) {
  std::vector<double> exposure(25);
  for (std::size_t i = 0; i < exposure.size(); ++i) exposure[i] = double(i) / 24;
  Bath bath(exposure);
  bath.scene.preTick(2);
  for (int i = 0; i < 25; ++i) EXPECT_NEAR(bath.scene.cloth().saturation(i), soaked(2, i / 24.0), 1e-14) << i;
}

TEST(AbsorptionExposure, WaterlineWetsWhatIsBelowIt) {
  Bath bath([](const btVector3& position, const btVector3&) { return position.x() < 0 ? 1.0 : 0.0; });
  bath.scene.preTick(2);
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 5; ++i) {
      const double expected = i < 2 ? soaked(2, 1) : 0;  // columns at x = -0.5, -0.25, 0, 0.25, 0.5
      EXPECT_NEAR(bath.scene.cloth().saturation(5 * j + i), expected, 1e-14) << i << " " << j;
    }
  }
}

TEST(AbsorptionExposure, WaterlineReachesAFallingClothWhenItGetsThere) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, levelPatch(3, 1));
  scene.cloth().add<Absorption>(Bath::parametersOf(
      [](const btVector3& position, const btVector3&) { return position.y() < btScalar(-1.2) ? 1.0 : 0.0; }));
  scene.step(118);  // sqrt(2 x 1.2 m / g) = 0.4946 s is 118.7 substeps
  EXPECT_EQ(scene.cloth().ledger().held, 0);
  scene.step(6);
  EXPECT_GT(scene.cloth().ledger().held, 0);
}

TEST(AbsorptionExposure, FunctionIsTakenAtTheUnitNormal) {
  double shortest = 2;
  double longest = 0;
  double alongY = 1;
  Bath bath([&](const btVector3&, const btVector3& normal) {
    shortest = std::min(shortest, double(normal.length()));
    longest = std::max(longest, double(normal.length()));
    alongY = std::min(alongY, double(std::fabs(normal.y())));
    return normal.y() > 0 ? 1.0 : 0.25;
  });
  bath.scene.preTick(2);
  EXPECT_NEAR(shortest, 1, 1e-5);  // float32 normalises to 1e-7
  EXPECT_NEAR(longest, 1, 1e-5);
  EXPECT_NEAR(alongY, 1, 1e-5);  // the patch lies in the plane y = 0
  const double up = bath.scene.body().m_nodes[12].m_n.y() > 0 ? 1.0 : 0.25;
  for (int i = 0; i < 25; ++i) EXPECT_NEAR(bath.scene.cloth().saturation(i), soaked(2, up), 1e-14);
}

TEST(AbsorptionExposure, FunctionValuesAreClampedAndNanIsDry) {
  const btVector3 anywhere(0, 0, 0);
  const auto constant = [](double value) {
    return Exposure([value](const btVector3&, const btVector3&) { return value; });
  };
  EXPECT_EQ(constant(7).at(0, anywhere, anywhere, 0), 1);
  EXPECT_EQ(constant(-7).at(0, anywhere, anywhere, 0), 0);
  EXPECT_EQ(constant(0.5).at(0, anywhere, anywhere, 0), 0.5);
  EXPECT_EQ(constant(kNaN).at(0, anywhere, anywhere, 0), 0);
  EXPECT_EQ(constant(std::numeric_limits<double>::infinity()).at(0, anywhere, anywhere, 0), 1);
}

// e(t) = t / 8 s: what counts is its integral, t^2 / 16 s, which the middle of each step has exactly.
TEST(AbsorptionExposure, FunctionOfTimeIsTakenInTheMiddleOfTheStep) {
  for (const int steps : {1, 2, 8}) {
    Bath bath([](const btVector3&, const btVector3&, double time) { return time / 8; });
    for (int i = 0; i < steps; ++i) bath.scene.preTick(8.0 / steps);
    for (int i = 0; i < 25; ++i) EXPECT_NEAR(bath.scene.cloth().saturation(i), soaked(4, 1), 1e-14) << steps;
  }
}

TEST(AbsorptionExposure, FunctionOfTimeMakesTheStepOfSecondOrder) {
  const auto errorOf = [](int steps) {
    Bath bath([](const btVector3&, const btVector3&, double time) { return std::exp(-time); });
    for (int i = 0; i < steps; ++i) bath.scene.preTick(8.0 / steps);
    return bath.scene.cloth().saturation(7) - soaked(-std::expm1(-8.0), 1);
  };
  EXPECT_NEAR(errorOf(64) / errorOf(128), 4, 0.01);
}

TEST(AbsorptionExposure, FunctionOfTimeIsClampedAndNotEmpty) {
  const btVector3 anywhere(0, 0, 0);
  const Exposure later([](const btVector3&, const btVector3&, double time) { return time - 3; });
  EXPECT_TRUE(later.isFunction());
  EXPECT_EQ(later.at(0, anywhere, anywhere, 3.25), 0.25);
  EXPECT_EQ(later.at(0, anywhere, anywhere, 0), 0);
  EXPECT_EQ(later.at(0, anywhere, anywhere, 10), 1);
  EXPECT_EQ(later.at(0, anywhere, anywhere, kNaN), 0);
  for (const Exposure& empty : {Exposure(Exposure::Function()), Exposure(Exposure::FunctionOfTime())}) {
    EXPECT_NE(rejection([&] { Absorption{Bath::parametersOf(empty)}; }).find("exposure"), std::string::npos);
  }
}

TEST(AbsorptionExposure, NodesBeyondTheArrayAreDry) {
  const btVector3 anywhere(0, 0, 0);
  const Exposure exposure(std::vector<double>{0.25, 0.75});
  EXPECT_EQ(exposure.at(1, anywhere, anywhere, 0), 0.75);
  EXPECT_EQ(exposure.at(2, anywhere, anywhere, 0), 0);
}

TEST(AbsorptionExposure, SetExposureTakesEffectInTheNextStep) {
  Bath bath(1.0);
  bath.scene.preTick(2);
  adjust(bath.effect, [](auto& p) { p.exposure = 0.5; });
  bath.scene.preTick(2);
  EXPECT_NEAR(bath.scene.cloth().saturation(7), soaked(3, 1), 1e-14);  // 2 + 0.5 x 2
}

TEST(AbsorptionExposure, BadExposureIsRefusedAndNothingChanges) {
  Bath bath(1.0);
  for (double bad : {-0.01, 1.01, kNaN, std::numeric_limits<double>::infinity()}) {
    EXPECT_NE(rejection([&] { adjust(bath.effect, [&](auto& p) { p.exposure = bad; }); }).find("exposure"),
              std::string::npos)
        << bad;
    EXPECT_NE(rejection([&] { Absorption{Bath::parametersOf(bad)}; }).find("exposure"), std::string::npos) << bad;
  }
  std::vector<double> withOneBad(25, 0.5);
  withOneBad[17] = 1.5;
  const std::string message = rejection([&] { adjust(bath.effect, [&](auto& p) { p.exposure = withOneBad; }); });
  EXPECT_NE(message.find("17"), std::string::npos) << message;
  EXPECT_NE(message.find("1.5"), std::string::npos) << message;
  bath.scene.preTick(2);
  EXPECT_NEAR(bath.scene.cloth().saturation(3), soaked(2, 1), 1e-14);
}

TEST(AbsorptionExposure, ArrayOfTheWrongSizeIsRefusedWhenTheEffectIsAddedOrChanged) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(5, 1), Fabric::cotton(), Hook::manual);
  const auto add = [&] { scene.cloth().add<Absorption>(Bath::parametersOf(std::vector<double>(24, 0.5))); };
  EXPECT_NE(rejection(add).find("exposure"), std::string::npos);
  EXPECT_TRUE(scene.cloth().effects().empty());
  scene.preTick(1);
  EXPECT_EQ(scene.cloth().ledger().held, 0);
}

TEST(AbsorptionExposure, AnEmptyArrayOrFunctionIsRefused) {
  const auto refusalOf = [](const Exposure& exposure) {
    return rejection([&] { Absorption{Bath::parametersOf(exposure)}; });
  };
  EXPECT_NE(refusalOf(std::vector<double>()).find("Absorption.exposure.size() = 0"), std::string::npos);
  EXPECT_NE(refusalOf(Exposure::Function()).find("Absorption.exposure"), std::string::npos);
}

TEST(AbsorptionExposure, OtherBadParametersAreNamed) {
  Absorption::Parameters velocity;
  velocity.waterVelocity = btVector3(0, btScalar(kNaN), 0);
  EXPECT_NE(rejection([&] { Absorption{velocity}; }).find("waterVelocity"), std::string::npos);
  for (double bad : {0.0, -1.0, kNaN, std::numeric_limits<double>::infinity()}) {
    Absorption::Parameters ramp;
    ramp.rampDuration = bad;
    EXPECT_NE(rejection([&] { Absorption{ramp}; }).find("rampDuration"), std::string::npos) << bad;
  }
}

// --- a settled cloth costs nothing ---------------------------------------------------------------------------

TEST(AbsorptionIdles, AtSaturation) {
  Bath bath(1.0);
  bath.scene.preTick(1000);  // 113 time constants: full to the last digit
  bath.scene.preTick(1);
  const long long visited = bath.effect.nodesVisited();
  const long long commits = bath.scene.cloth().masses().commits();
  for (int i = 0; i < 1000; ++i) bath.scene.preTick(kSubstep);
  EXPECT_EQ(bath.effect.nodesVisited(), visited);
  EXPECT_EQ(bath.scene.cloth().masses().commits(), commits);
}

TEST(AbsorptionIdles, AtSaturationWhateverFunctionTheExposureIs) {
  Bath bath([](const btVector3&, const btVector3&) { return 1.0; });
  bath.scene.cloth().setSaturation(1);
  bath.scene.preTick(1);
  const long long visited = bath.effect.nodesVisited();
  for (int i = 0; i < 100; ++i) bath.scene.preTick(1);
  EXPECT_EQ(bath.effect.nodesVisited(), visited);
}

TEST(AbsorptionIdles, AwayFromWater) {
  Bath bath(0.0);
  bath.scene.preTick(1);
  const long long visited = bath.effect.nodesVisited();
  for (int i = 0; i < 100; ++i) bath.scene.preTick(1);
  EXPECT_EQ(bath.effect.nodesVisited(), visited);
  EXPECT_EQ(bath.scene.cloth().ledger().held, 0);
}

TEST(AbsorptionIdles, AndWorksWhileItSoaks) {
  Bath bath(1.0);
  for (int i = 0; i < 10; ++i) bath.scene.preTick(kSubstep);
  EXPECT_EQ(bath.effect.nodesVisited(), 10 * 25);
}

TEST(AbsorptionIdles, UntilWaterLeaves) {
  Bath bath(1.0);
  bath.scene.cloth().setSaturation(1);
  for (int i = 0; i < 10; ++i) bath.scene.preTick(1);
  const long long visited = bath.effect.nodesVisited();
  const double capacity = bath.scene.cloth().capacity(12);
  EXPECT_DOUBLE_EQ(bath.scene.cloth().water().drip(12, capacity / 2), capacity / 2);
  bath.scene.preTick(2);
  EXPECT_GT(bath.effect.nodesVisited(), visited);
  EXPECT_NEAR(bath.scene.cloth().saturation(12), 1 - 0.5 * std::exp(-2 / kTheta), 1e-14);
}

TEST(AbsorptionIdles, UntilTheExposureChanges) {
  Bath bath(0.0);
  for (int i = 0; i < 10; ++i) bath.scene.preTick(1);
  adjust(bath.effect, [](auto& p) { p.exposure = 1.0; });
  bath.scene.preTick(2);
  EXPECT_NEAR(bath.scene.cloth().saturation(0), soaked(2, 1), 1e-14);
}

// A mass that the application changed counts from the next commit on, here in the step in which the cloth fills.
TEST(AbsorptionIdles, UntilANodeCanHoldMore) {
  Bath bath(1.0);
  bath.scene.preTick(1);
  bath.scene.node(0).m_im /= 4;
  for (int i = 0; i < 3; ++i) bath.scene.preTick(1e3);
  EXPECT_EQ(bath.scene.cloth().saturation(0), 1);
}

TEST(AbsorptionIdles, UntilWaterIsSetByHand) {
  Bath bath(1.0);
  bath.scene.cloth().setSaturation(1);
  for (int i = 0; i < 10; ++i) bath.scene.preTick(1);
  bath.scene.cloth().setSaturation(0);
  bath.scene.preTick(2);
  EXPECT_NEAR(bath.scene.cloth().saturation(0), soaked(2, 1), 1e-14);
}

}  // namespace
}  // namespace wetcloth_test::absorption_exposure_test
