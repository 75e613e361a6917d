// SPDX-License-Identifier: Zlib
// How much rain a cloth catches, what of it goes in and what runs off.

#include "bullet_wetcloth/effects/Rain.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"
#include "tests/support/SoftBodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace wetcloth_test::rain_test {
namespace {

using wetcloth::Fabric;
using wetcloth::Hook;
using wetcloth::Rain;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// An area is of positions, and a direction of length 1, rounded to Bullet's scalar: 6e-8 in float32.
constexpr double kGeometry = kIsDouble ? 1e-12 : 1e-6;

/// A level square of 1 m x 1 m; only our part of the step.
struct Shower {
  explicit Shower(const Rain::Parameters& parameters, const Fabric& fabric = Fabric::cotton(), int n = 5)
      : scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(n, 1), fabric, Hook::manual),
        effect(scene.cloth().add<Rain>(parameters)) {}
  wetcloth::Ledger ledger() { return scene.cloth().ledger(); }
  ClothScene scene;
  Rain& effect;
};

Rain::Parameters falling(const btVector3& direction, double flux = 2.8e-3) {
  Rain::Parameters parameters;
  parameters.direction = direction;
  parameters.flux = flux;
  return parameters;
}

const btVector3 kA(0, 0, 0);
const btVector3 kB(3, 0, 0);
const btVector3 kC(0, 0, 4);  // 6 m^2

TEST(CaughtFlux, IsFluxTimesAreaAcrossTheStream) {
  EXPECT_NEAR(wetcloth::caughtFlux(kA, kB, kC, btVector3(0, -1, 0), 0.5), 3, 3 * kGeometry);
}

TEST(CaughtFlux, FallsWithTheCosineOfTheAngle) {
  for (const double angle : {0.1, 0.7, 1.2, 1.5}) {
    const btVector3 direction(btScalar(std::sin(angle)), btScalar(-std::cos(angle)), 0);
    EXPECT_NEAR(wetcloth::caughtFlux(kA, kB, kC, direction, 1), 6 * std::cos(angle), 6 * kGeometry) << angle;
  }
  EXPECT_NEAR(wetcloth::caughtFlux(kA, kB, kC, btVector3(1, 0, 2), 1), 0, 6 * kGeometry) << "along the surface";
}

TEST(CaughtFlux, IsTheSameOnBothSidesAndForAnyOrderOfCorners) {
  const btVector3 direction(1, -2, btScalar(0.5));
  const double caught = wetcloth::caughtFlux(kA, kB, kC, direction, 1);
  EXPECT_EQ(wetcloth::caughtFlux(kA, kB, kC, -direction, 1), caught);
  EXPECT_NEAR(wetcloth::caughtFlux(kA, kC, kB, direction, 1), caught, 1e-14);
  EXPECT_NEAR(wetcloth::caughtFlux(kB, kC, kA, direction, 1), caught, 1e-14);
}

TEST(CaughtFlux, DoesNotDependOnTheDirectionsLength) {
  const double caught = wetcloth::caughtFlux(kA, kB, kC, btVector3(1, -2, 0), 1);
  for (const double length : {1e-30, 1e-3, 1e3, 1e30}) {
    const btVector3 direction(btScalar(length), btScalar(-2 * length), 0);
    EXPECT_NEAR(wetcloth::caughtFlux(kA, kB, kC, direction, 1), caught, caught * kGeometry) << length;
  }
}

TEST(CaughtFlux, IsNothingForWhatHasNoAreaOrIsNoNumber) {
  const btVector3 down(0, -1, 0);
  EXPECT_EQ(wetcloth::caughtFlux(kA, kB, kB, down, 1), 0);
  EXPECT_EQ(wetcloth::caughtFlux(kA, kB, kB * 2, down, 1), 0);
  EXPECT_EQ(wetcloth::caughtFlux(kA, kB, kC, btVector3(0, 0, 0), 1), 0);
  EXPECT_EQ(wetcloth::caughtFlux(kA, kB, kC, btVector3(0, btScalar(kNaN), 0), 1), 0);
  EXPECT_EQ(wetcloth::caughtFlux(kA, kB, btVector3(0, 0, btScalar(kInfinity)), down, 1), 0);
  EXPECT_EQ(wetcloth::caughtFlux(kA, kB, kC, down, 0), 0);
}

TEST(RainCaught, ALevelSquareTakesFluxTimesAreaTimesTime) {
  Shower shower(falling(btVector3(0, -1, 0)));
  double time = 0;
  for (int i = 0; i < 1000; ++i) {
    shower.scene.preTick(0.01);
    time += double(btScalar(0.01));
  }
  EXPECT_NEAR(shower.ledger().absorbed / (2.8e-3 * time), 1, kGeometry);
  EXPECT_EQ(shower.ledger().runOff, 0);
  EXPECT_NEAR(shower.effect.caught(), 2.8e-3 * 0.01, 2.8e-5 * kGeometry + 1e-12);
}

// Rounding of equal small portions is the same each time; the carry keeps it.
TEST(RainCaught, SmallPortionsAreNotLost) {
  Shower shower(falling(btVector3(0, -1, 0), 1e-3), Fabric::cotton(), 2);
  double time = 0;
  for (int i = 0; i < 100000; ++i) {
    shower.scene.preTick(1e-5);
    time += double(btScalar(1e-5));
  }
  // 1e-11: of the sum of 100000 times in this test.
  EXPECT_NEAR(shower.ledger().absorbed / (1e-3 * time), 1, kIsDouble ? 1e-11 : 1e-6);
}

TEST(RainCaught, ASlantedRainIsCaughtByTheProjection) {
  Shower shower(falling(btVector3(3, -4, 0)));
  shower.scene.preTick(1);
  EXPECT_NEAR(shower.ledger().absorbed, 2.8e-3 * 0.8, 2.8e-3 * kGeometry);
}

// Corner nodes of the square have one or two triangles, edges three, and inner ones six, of a 32nd m^2 each.
TEST(RainCaught, EachNodeGetsAThirdOfItsTriangles) {
  Shower shower(falling(btVector3(0, -1, 0)));
  shower.scene.preTick(1);
  double corners = 0;
  for (const int node : {0, 4, 20, 24}) corners += shower.scene.cloth().held(node);
  EXPECT_NEAR(corners, 2.8e-3 * 6 / 32 / 3, 1e-9);
  EXPECT_NEAR(shower.scene.cloth().held(12), 2.8e-3 * 6 / 32 / 3, 1e-9);
  EXPECT_NEAR(shower.scene.cloth().held(2), 2.8e-3 * 3 / 32 / 3, 1e-9);
}

TEST(RainCaught, ThePresentShapeCounts) {
  Shower shower(falling(btVector3(0, -1, 0)));
  for (int i = 0; i < 25; ++i) shower.scene.node(i).m_x *= btScalar(0.5);
  shower.scene.preTick(1);
  EXPECT_NEAR(shower.ledger().absorbed, 2.8e-3 / 4, 2.8e-3 * kGeometry);
}

TEST(RainRunOff, ANodeTakesWhatItCanHoldAndTheRestIsCounted) {
  for (const double dt : {1e-6, 1e-3, 1.0, 1e3}) {
    Shower shower(falling(btVector3(0, -1, 0)));
    shower.scene.cloth().setSaturation(1 - 1e-7);
    const double before = shower.ledger().held;
    const double capacity = shower.scene.cloth().totalMass() - before;
    double caught = 0;
    for (int i = 0; i < 100; ++i) {
      shower.scene.preTick(dt);
      caught += shower.effect.caught();
    }
    const wetcloth::Ledger ledger = shower.ledger();
    EXPECT_NEAR(ledger.absorbed + ledger.runOff, caught, 1e-12 * caught + 1e-16 * capacity) << dt;
    EXPECT_NEAR(ledger.held, before + ledger.absorbed, 1e-15) << dt;
    for (int i = 0; i < 25; ++i) {
      EXPECT_GE(shower.scene.cloth().saturation(i), 1 - 1e-7) << dt;
      EXPECT_LE(shower.scene.cloth().saturation(i), 1 + 1e-15) << dt;  // the rounding of the last drop
    }
    if (dt >= 1e-3) {
      EXPECT_DOUBLE_EQ(shower.scene.cloth().saturation(12), 1) << dt;
    }
  }
}

TEST(RainRunOff, LeavesAnOverfullNodeAsItIs) {
  Shower shower(falling(btVector3(0, -1, 0)));
  std::vector<double> held(25, 0.0);
  held[12] = 2 * shower.scene.cloth().capacity(12);
  shower.scene.cloth().setHeld(held);
  shower.scene.preTick(1);
  EXPECT_EQ(shower.scene.cloth().held(12), held[12]);
  EXPECT_NEAR(shower.ledger().runOff, 2.8e-3 * 6 / 32 / 3, 1e-9);
}

// The flow's momentum, whether it goes in or runs off; the balance takes the impact of each node as inelastic.
TEST(RainMomentum, IsThatOfTheDropsThatGoIn) {
  Rain::Parameters parameters = falling(btVector3(3, -4, 0), 1e-2);
  parameters.speed = 5;
  Shower shower(parameters);
  setVelocity(shower.scene.body(), btVector3(0, 1, 2));
  const auto before = momentum(shower.scene.body());
  for (int i = 0; i < 50; ++i) shower.scene.preTick(0.02);
  const double absorbed = shower.ledger().absorbed;
  ASSERT_GT(absorbed, 0.005);
  ASSERT_EQ(shower.ledger().runOff, 0);
  const auto after = momentum(shower.scene.body());
  const double scale = shower.scene.cloth().totalMass() * 5;
  EXPECT_NEAR(after[0], before[0] + absorbed * 3, scale * (kIsDouble ? 1e-12 : 1e-5));
  EXPECT_NEAR(after[1], before[1] - absorbed * 4, scale * (kIsDouble ? 1e-12 : 1e-5));
  EXPECT_NEAR(after[2], before[2], scale * (kIsDouble ? 1e-12 : 1e-5));
}

TEST(RainMomentum, OfDropsThatRunOffPushesAClothThatIsFull) {
  Rain::Parameters parameters = falling(btVector3(0, -1, 0), 1e-2);
  parameters.speed = 5;
  Shower shower(parameters, Fabric::cotton(), 3);
  shower.scene.cloth().setSaturation(1);
  shower.scene.preTick(0.5);
  // A third of each triangle of an eighth m^2, so node 4 with six of them is struck by 1e-2 / 4 kg/s.
  const double struck = 1e-2 * 0.5 / 4;
  const double mass = 1 / double(shower.scene.node(4).m_im);
  EXPECT_NEAR(double(shower.scene.node(4).m_v.y()), -5 * struck / (mass + struck), kGeometry);
  EXPECT_NEAR(shower.ledger().runOff, 1e-2 * 0.5, 1e-2 * kGeometry);
  EXPECT_EQ(shower.ledger().absorbed, 0);
}

TEST(RainIdles, WhileTheFluxIsZero) {
  Shower shower(falling(btVector3(0, -1, 0), 0));
  for (int i = 0; i < 10; ++i) shower.scene.preTick(1);
  EXPECT_EQ(shower.effect.nodesVisited(), 0);
  adjust(shower.effect, [](auto& p) { p.flux = 1e-3; });
  shower.scene.preTick(1);
  EXPECT_EQ(shower.effect.nodesVisited(), 25);
  EXPECT_NEAR(shower.ledger().absorbed, 1e-3, 1e-3 * kGeometry);
  adjust(shower.effect, [](auto& p) { p.flux = 0; });
  shower.scene.preTick(1);
  EXPECT_EQ(shower.effect.nodesVisited(), 25);
  EXPECT_EQ(shower.effect.caught(), 0);
}

TEST(RainIdles, AFullClothTouchesNoMasses) {
  Shower shower(falling(btVector3(0, -1, 0)));
  shower.scene.cloth().setSaturation(1);
  shower.scene.preTick(1);
  const long long commits = shower.scene.cloth().masses().commits();
  for (int i = 0; i < 10; ++i) shower.scene.preTick(1);
  EXPECT_EQ(shower.scene.cloth().masses().commits(), commits);
}

TEST(RainSetters, TakeEffectInTheNextStep) {
  Shower shower(falling(btVector3(0, -1, 0)));
  adjust(shower.effect, [](auto& p) { p.direction = btVector3(1, 0, 0); });  // along the cloth
  shower.scene.preTick(1);
  EXPECT_NEAR(shower.ledger().absorbed, 0, 1e-9);
  adjust(shower.effect, [](auto& p) { p.direction = btVector3(0, 7, 0); });
  adjust(shower.effect, [](auto& p) { p.speed = 0; });
  shower.scene.preTick(1);
  EXPECT_NEAR(shower.ledger().absorbed, 2.8e-3, 2.8e-3 * kGeometry);
  EXPECT_EQ(shower.scene.node(12).m_v.y(), 0);
}

TEST(RainBadInput, NamesTheFieldAndChangesNothing) {
  Shower shower(falling(btVector3(0, -1, 0)));
  const auto refused = [](const Rain::Parameters& parameters, const char* field) {
    EXPECT_NE(rejection([&] { Rain{parameters}; }).find(field), std::string::npos) << field;
  };
  for (const double bad : {-1.0, kNaN, kInfinity}) {
    refused(falling(btVector3(0, -1, 0), bad), "Rain.flux = ");
    EXPECT_NE(rejection([&] { adjust(shower.effect, [&](auto& p) { p.flux = bad; }); }).find("Rain.flux"),
              std::string::npos);
    Rain::Parameters parameters;
    parameters.speed = bad;
    refused(parameters, "Rain.speed = ");
    EXPECT_NE(rejection([&] { adjust(shower.effect, [&](auto& p) { p.speed = bad; }); }).find("Rain.speed"),
              std::string::npos);
  }
  for (const double bad : {kNaN, kInfinity}) {
    const btVector3 direction(0, 0, btScalar(bad));
    refused(falling(direction), "Rain.direction.z");
    EXPECT_NE(
        rejection([&] { adjust(shower.effect, [&](auto& p) { p.direction = direction; }); }).find("Rain.direction.z"),
        std::string::npos);
  }
  refused(falling(btVector3(0, 0, 0)), "Rain.direction");
  EXPECT_NE(rejection([&] {
              adjust(shower.effect, [](auto& p) { p.direction = btVector3(0, 0, 0); });
            }).find("Rain.direction"),
            std::string::npos);
  EXPECT_EQ(rejection([&] { Rain{falling(btVector3(0, btScalar(-1e-30), 0))}; }), "") << "of any length";
  shower.scene.preTick(1);
  EXPECT_NEAR(shower.ledger().absorbed, 2.8e-3, 2.8e-3 * kGeometry);
}

TEST(RainBadInput, ARopeCatchesNone) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), hangingRope(3, 0.1, 0.01));
  const std::string message = rejection([&] { scene.cloth().add<Rain>(); });
  EXPECT_NE(message.find("Rain: body.m_faces.size() = 0"), std::string::npos) << message;
  EXPECT_TRUE(scene.cloth().effects().empty());
}

}  // namespace
}  // namespace wetcloth_test::rain_test
