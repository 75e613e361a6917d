// SPDX-License-Identifier: Zlib
// Water thrown in a sphere or from a hose: what a cloth catches of it, against the stream's own flow.

#include "bullet_wetcloth/effects/Splash.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace wetcloth_test::splash_test {
namespace {

using wetcloth::Fabric;
using wetcloth::Hook;
using wetcloth::Splash;

constexpr double kPi = 3.14159265358979323846;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// An area is of positions, and a direction of length 1, rounded to Bullet's scalar: 6e-8 in float32.
constexpr double kGeometry = kIsDouble ? 1e-12 : 1e-6;

Splash::Parameters sphere(const btVector3& centre, double radius, double flux = 0.1) {
  Splash::Parameters parameters;
  parameters.region = Splash::Sphere{centre, radius};
  parameters.flux = flux;
  return parameters;
}

/// A hose above the origin that points down.
Splash::Parameters hose(double height, double halfAngle, double reach, double flux = 0.1) {
  Splash::Parameters parameters;
  parameters.region = Splash::Cone{btVector3(0, btScalar(height), 0), halfAngle, reach};
  parameters.flux = flux;
  return parameters;
}

/// A level square of 1 m x 1 m about the origin, of so thirsty a fabric that nothing runs off; only our part of the
/// step.
struct Yard {
  explicit Yard(const Splash::Parameters& parameters, int n = 5, const Fabric& fabric = thirsty())
      : scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(n, 1), fabric, Hook::manual),
        effect(scene.cloth().add<Splash>(parameters)) {}
  static Fabric thirsty() {
    Fabric fabric;
    fabric.capacity = 1e6;
    return fabric;
  }
  wetcloth::Ledger ledger() { return scene.cloth().ledger(); }
  btVector3 centroid(int face) {
    btSoftBody::Node* const* corners = scene.body().m_faces[face].m_n;
    return (corners[0]->m_x + corners[1]->m_x + corners[2]->m_x) / 3;
  }
  ClothScene scene;
  Splash& effect;
};

TEST(ConeFlux, GivesTheSameFlowThroughEveryCrossSection) {
  const double flow = wetcloth::coneFlow(0.3, 0.1, 2);
  EXPECT_NEAR(flow, 0.1 * 2 * kPi * (1 - std::cos(0.3)) * 4, 1e-14);
  for (const double distance : {0.02, 0.1, 1.0, 2.0}) {
    const double cap = 2 * kPi * (1 - std::cos(0.3)) * distance * distance;
    EXPECT_NEAR(wetcloth::coneFlux(distance, 0.1, 2) * cap, flow, 1e-13) << distance;
  }
}

TEST(ConeFlux, GrowsNoMoreNearTheMouth) {
  EXPECT_NEAR(wetcloth::coneFlux(0.01, 0.1, 1), 1000, 1e-10);
  EXPECT_NEAR(wetcloth::coneFlux(1e-9, 0.1, 1), 1000, 1e-10);
  EXPECT_NEAR(wetcloth::coneFlux(0, 0.1, 1), 1000, 1e-10);
}

TEST(ConeFlux, OfAVeryNarrowHoseKeepsItsDigits) {
  EXPECT_NEAR(wetcloth::coneFlow(1e-6, 1, 1) / (kPi * 1e-12), 1, 1e-12);  // 1 - cos(1e-6) has four digits
}

TEST(SplashSphere, ASquareAcrossTheStreamTakesFluxTimesAreaTimesTime) {
  Yard yard(sphere(btVector3(0, 0, 0), 1));
  double time = 0;
  for (int i = 0; i < 100; ++i) {
    yard.scene.preTick(0.01);
    time += double(btScalar(0.01));
  }
  EXPECT_NEAR(yard.ledger().absorbed / (0.1 * time), 1, kGeometry);
  EXPECT_EQ(yard.ledger().runOff, 0);
}

TEST(SplashSphere, WetsTheTrianglesWhoseCentroidsAreInside) {
  // Around a corner of the square, reaching over 2 of its 32 triangles: centroids at a twelfth and two twelfths.
  Yard yard(sphere(btVector3(btScalar(-0.5), 0, btScalar(-0.5)), 0.24));
  yard.scene.preTick(0.01);
  EXPECT_NEAR(yard.ledger().absorbed, 0.1 * 0.01 * 2 / 32, 1e-9);
  EXPECT_EQ(yard.scene.cloth().held(12), 0);
  EXPECT_GT(yard.scene.cloth().held(0), 0);
}

TEST(SplashSphere, ASlantedStreamIsCaughtByTheProjection) {
  Splash::Parameters parameters = sphere(btVector3(0, 0, 0), 1);
  parameters.velocity = btVector3(3, -4, 0);
  Yard yard(parameters);
  yard.scene.preTick(1);
  EXPECT_NEAR(yard.ledger().absorbed, 0.1 * 0.8, 0.1 * kGeometry);
}

// A square much larger than the stream has but few centroids in it, or many layers would catch it again and again.
TEST(SplashSphere, NoMoreIsCaughtThanTheStreamCarries) {
  Yard yard(sphere(btVector3(0, 0, 0), 1), 2);
  adjust(yard.effect, [&](auto& p) { p.region = Splash::Sphere{yard.centroid(0), 0.1}; });
  yard.scene.preTick(1);
  EXPECT_NEAR(yard.ledger().absorbed, 0.1 * kPi * 0.01, 1e-8);
  EXPECT_NEAR(yard.effect.caught(), 0.1 * kPi * 0.01, 1e-8);
}

// The error is that of the jagged border: it falls with the mesh width.
TEST(SplashCone, ALargeSheetCatchesTheHosesFlowWhateverTheDistance) {
  const double halfAngle = 0.4;
  for (const double height : {0.4, 0.8}) {
    const double flow = wetcloth::coneFlow(halfAngle, 0.1, 1);
    double error = 1;
    for (const int n : {11, 41, 161}) {
      Yard yard(hose(height, halfAngle, 1), n);
      yard.scene.preTick(0.5);
      error = std::fabs(yard.ledger().absorbed / (0.5 * flow) - 1);
      // The border is 2 pi tan(0.4) height long and cuts triangles of the mesh width; the halves of them that are in
      // by mistake and out by mistake cancel for the most part.
      EXPECT_LT(error, 2.0 / (n - 1) / height) << height << " " << n;
    }
    EXPECT_LT(error, 0.01);
  }
}

TEST(SplashCone, EndsAtItsReachAndItsSideAndDoesNotLookBack) {
  Yard beyond(hose(1.2, 0.4, 1));
  beyond.scene.preTick(1);
  EXPECT_EQ(beyond.ledger().absorbed, 0);
  Yard behind(hose(-0.1, 0.4, 1));
  behind.scene.preTick(1);
  EXPECT_EQ(behind.ledger().absorbed, 0);
  Yard within(hose(0.5, 0.2, 1), 21);  // wets a circle of 0.10 m
  within.scene.preTick(1);
  for (int i = 0; i < 441; ++i) {
    const double r = double(within.scene.node(i).m_x.length());
    // A node is wet when it has a triangle in: those are of 0.05 m.
    if (r < 0.06) {
      EXPECT_GT(within.scene.cloth().held(i), 0) << r;
    } else if (r > 0.1 + 0.05) {
      EXPECT_EQ(within.scene.cloth().held(i), 0) << r;
    }
  }
}

TEST(SplashCone, AtItsMouthGivesNoMoreThanItsFlow) {
  for (const double height : {0.0, 1e-6, 0.01}) {
    Yard yard(hose(height, 1.0, 1), 4);
    Splash::Cone cone = std::get<Splash::Cone>(yard.effect.parameters().region);
    cone.apex = yard.centroid(7) + btVector3(0, btScalar(height), 0);
    adjust(yard.effect, [&](auto& p) { p.region = cone; });
    yard.scene.preTick(1);
    const double flow = wetcloth::coneFlow(1.0, 0.1, 1);
    EXPECT_TRUE(std::isfinite(yard.ledger().absorbed));
    EXPECT_LE(yard.ledger().absorbed, flow * (1 + kGeometry)) << height;
    EXPECT_GT(yard.ledger().absorbed, 0) << height;
  }
}

// Each drop flies on its own way: the sheet is pushed down, and its sides outwards, evenly on both.
TEST(SplashCone, DropsFlyFromTheApex) {
  Yard yard(hose(0.5, 0.7, 2), 9, Fabric::cotton());
  yard.scene.preTick(0.1);
  ASSERT_GT(yard.ledger().absorbed, 0);
  const auto total = momentum(yard.scene.body());
  const double scale = 5 * (yard.ledger().absorbed + yard.ledger().runOff);
  // The diagonals of the patch are not symmetric, the sheet is otherwise.
  EXPECT_NEAR(total[0], 0, 0.02 * scale);
  EXPECT_NEAR(total[2], 0, 0.02 * scale);
  EXPECT_LT(total[1], -0.8 * scale);
  EXPECT_GT(total[1], -scale);
  const int left = 4 * 9 + 2;
  const int right = 4 * 9 + 6;
  EXPECT_LT(yard.scene.node(left).m_v.x(), 0);
  EXPECT_GT(yard.scene.node(right).m_v.x(), 0);
}

TEST(SplashMomentum, IsThatOfTheStreamToRounding) {
  Splash::Parameters parameters = sphere(btVector3(0, 0, 0), 1);
  parameters.velocity = btVector3(3, -4, 1);
  Yard yard(parameters, 5, Yard::thirsty());
  setVelocity(yard.scene.body(), btVector3(0, 1, 2));
  const auto before = momentum(yard.scene.body());
  for (int i = 0; i < 50; ++i) yard.scene.preTick(0.02);
  const double absorbed = yard.ledger().absorbed;
  const auto after = momentum(yard.scene.body());
  for (int k = 0; k < 3; ++k) {
    const auto c = std::size_t(k);
    EXPECT_NEAR(after[c], before[c] + absorbed * double(parameters.velocity[k]),
                (kIsDouble ? 1e-12 : 1e-5) * 5 * yard.scene.cloth().totalMass())
        << k;
  }
}

TEST(SplashRunOff, WhatAFullClothCannotTakeIsCountedAndPushes) {
  Yard yard(sphere(btVector3(0, 0, 0), 1), 3, Fabric::cotton());
  yard.scene.cloth().setSaturation(1);
  for (const double dt : {1e-6, 1e-3, 1e3}) {
    const double before = yard.ledger().runOff;
    yard.scene.preTick(dt);
    EXPECT_NEAR((yard.ledger().runOff - before) / (0.1 * double(btScalar(dt))), 1, 1e-6) << dt;  // of the difference
  }
  EXPECT_EQ(yard.ledger().absorbed, 0);
  // Struck by 25 kg a node, it flies with the stream.
  EXPECT_NEAR(double(yard.scene.node(4).m_v.y()), -5, 0.05);
  EXPECT_GE(double(yard.scene.node(4).m_v.y()), -5);
}

TEST(SplashIdles, BesideTheClothUntilItIsMovedThere) {
  Yard yard(sphere(btVector3(5, 0, 0), 1));
  for (int i = 0; i < 64; ++i) yard.scene.preTick(0.01);
  const long long visited = yard.effect.nodesVisited();
  for (int i = 0; i < 100; ++i) yard.scene.preTick(0.01);
  EXPECT_EQ(yard.effect.nodesVisited(), visited);
  adjust(yard.effect, [](auto& p) { p.region = Splash::Sphere{btVector3(0, 0, 0), 1}; });
  yard.scene.preTick(0.01);
  EXPECT_EQ(yard.effect.nodesVisited(), visited + 25);
  EXPECT_NEAR(yard.ledger().absorbed, 0.1 * 0.01, 1e-9);
}

TEST(SplashIdles, UntilTheClothComes) {
  Yard yard(sphere(btVector3(0, 5, 0), 1));
  for (int i = 0; i < 100; ++i) yard.scene.preTick(0.01);
  for (int i = 0; i < 25; ++i) yard.scene.node(i).m_x += btVector3(0, 5, 0);
  yard.scene.preTick(0.01);
  EXPECT_NEAR(yard.ledger().absorbed, 0.1 * 0.01, 1e-9);
}

TEST(SplashIdles, NotWhileItPushesAFullCloth) {
  Yard yard(sphere(btVector3(0, 0, 0), 1), 3, Fabric::cotton());
  yard.scene.cloth().setSaturation(1);
  for (int i = 0; i < 200; ++i) yard.scene.preTick(0.01);
  EXPECT_EQ(yard.effect.nodesVisited(), 200 * 9);
  EXPECT_NEAR(yard.ledger().runOff, 0.1 * 2, 1e-6);
}

TEST(SplashIdles, WithoutFlux) {
  Yard yard(sphere(btVector3(0, 0, 0), 1, 0));
  yard.scene.preTick(1);
  EXPECT_EQ(yard.effect.nodesVisited(), 0);
  adjust(yard.effect, [](auto& p) { p.flux = 0.1; });
  adjust(yard.effect, [](auto& p) { p.velocity = btVector3(0, 2, 0); });
  yard.scene.preTick(1);
  EXPECT_NEAR(yard.ledger().absorbed, 0.1, 1e-6);
  EXPECT_GT(yard.scene.node(12).m_v.y(), 0);
}

}  // namespace
}  // namespace wetcloth_test::splash_test
