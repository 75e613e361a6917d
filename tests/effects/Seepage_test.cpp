// SPDX-License-Identifier: Zlib
// Seepage: its formula, fronts, pools, what it leaves alone, and its balance with diffusion.

#include "tests/support/Rejection.h"
#include "tests/support/TransportScene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace wetcloth_test::seepage_test {

using namespace transport;

namespace {

using wetcloth::Diffusion;
using wetcloth::Seepage;

const btVector3 kDown(0, btScalar(-9.81), 0);

double heldBy(TransportScene& scene) { return scene.cloth().ledger().held; }

// Over the nodes of each height, where they are on a grid.
double meanSaturationAt(TransportScene& scene, double y) {
  double held = 0;
  double capacity = 0;
  for (int i = 0; i < scene.count(); ++i) {
    if (std::fabs(scene.y(i) - y) > 1e-6) continue;
    held += scene.cloth().held(i);
    capacity += scene.cloth().capacity(i);
  }
  return held / capacity;
}

TEST(SeepageFormulas, ConductivityIsAPowerOfTheSaturation) {
  for (const double exponent : {1.0, 2.5, 3.0}) {
    EXPECT_EQ(wetcloth::relativeConductivity(0, exponent), 0);
    EXPECT_EQ(wetcloth::relativeConductivity(1, exponent), 1);
    EXPECT_DOUBLE_EQ(wetcloth::relativeConductivity(0.25, exponent), std::pow(0.25, exponent));
  }
}

TEST(SeepageFormulas, TheUpperEndDrivesTheFlow) {
  EXPECT_DOUBLE_EQ(wetcloth::seepageFlow(2, 0.5, 2, 0.5, 1, 0.1), 2 * 0.5 * 0.25 * 0.1);
  EXPECT_DOUBLE_EQ(wetcloth::seepageFlow(2, 0.5, 2, 0.5, 1, -0.1), -2 * 0.5 * 1 * 0.1);
  EXPECT_EQ(wetcloth::seepageFlow(2, 0.5, 2, 1, 1, 0), 0);
}

// With n = 1 water falls at the speed v, whatever the saturation: its centre does so exactly, on any mesh.
TEST(Seepage, WaterSinksAtItsSpeed) {
  for (const double jitter : {0.0, 0.3}) {
    TransportScene scene(grid(9, 61, 0.2, 1.5, jitter), kDown);
    scene.wet([](double, double y) { return std::fabs(y - 1.1) < 0.151 ? 0.7 : 0.0; });
    const auto centre = [&] {
      double moment = 0;
      for (int i = 0; i < scene.count(); ++i) moment += scene.cloth().held(i) * scene.y(i);
      return moment / heldBy(scene);
    };
    const double before = centre();
    scene.cloth().add<Seepage>({1e-3, 1});
    scene.run(400, 1);
    // On an irregular mesh the thirds of triangles are not the volumes that the weights belong to: 2 %.
    EXPECT_NEAR(before - centre(), 0.4, jitter > 0 ? 0.008 : 0.002) << jitter;
  }
}

// A wet half above a dry one with n = 2: behind the upper end a fan s = depth / 2 v t, before it a front at the speed
// v (f(s) - f(0)) / s = v s until the fan reaches it.
TEST(Seepage, AFrontDescendsAtTheSpeedOfItsShock) {
  const int n = 201;
  TransportScene scene(grid(3, n, 0.02, 2), kDown);
  const double s0 = 0.8;
  scene.wet([&](double, double y) { return y > 1.2 ? s0 : 0.0; });
  const double v = 1e-3;
  scene.cloth().add<Seepage>({v, 2});
  const double t = 300;
  scene.run(300, 1);
  const double front = 1.2 - v * s0 * t;
  for (int j = 0; j < n; ++j) {
    const double y = 2 - 0.01 * j;
    const double s = meanSaturationAt(scene, y);
    // Upwind, of first order: the corner of the fan is rounded by a root of the spacing.
    if (y > front + 0.05) {
      EXPECT_NEAR(s, std::min(s0, (2 - y) / (2 * v * t)), 0.08) << y;
    }
    if (y < front - 0.08) {
      EXPECT_LT(s, 0.02) << y;
    }
  }
}

TEST(Seepage, PoolsAtTheLowerHemAndIsNeverOverfull) {
  for (const double dt : {0.1, 5.0, 1e3}) {
    TransportScene scene(grid(5, 21, 0.1, 0.4, 0.2), kDown);
    scene.wet([](double, double) { return 0.5; });
    const double before = heldBy(scene);
    scene.cloth().add<Seepage>({1e-2, 1});
    const int steps = int(std::max(200.0, 400 / dt));
    for (int k = 0; k < steps; ++k) {
      scene.preTick(dt);
      if (k % 50 == 0) {
        EXPECT_LE(scene.highest(), 1 + 1e-15) << dt;
      }
      if (k % 50 == 0) {
        EXPECT_GE(scene.lowest(), 0) << dt;
      }
    }
    EXPECT_NEAR(heldBy(scene), before, 1e-13 * before);
    for (int i = 0; i < scene.count(); ++i) {
      // Half of the water fills the lower half.
      if (scene.y(i) < 0.17) {
        EXPECT_NEAR(scene.s(i), 1, 1e-9) << scene.y(i) << ' ' << dt;
      }
      if (scene.y(i) > 0.23) {
        EXPECT_LT(scene.s(i), 0.01) << scene.y(i) << ' ' << dt;
      }
    }
  }
}

TEST(Seepage, ASaturatedClothHasNowhereToSendItsWater) {
  TransportScene scene(grid(5, 9, 0.1, 0.2, 0.3), kDown);
  scene.wet([](double, double) { return 1; });
  scene.cloth().add<Seepage>({1e-3, 3});
  scene.run(10, 1);
  for (int i = 0; i < scene.count(); ++i) EXPECT_NEAR(scene.s(i), 1, 1e-15);
}

TEST(Seepage, NothingMovesOnALevelClothOrWithoutGravity) {
  Mesh level = grid(5, 5, 0.1, 0.1);
  for (btVector3& p : level.points) p = btVector3(p.x(), 0, p.y());
  for (const bool isLevel : {true, false}) {
    TransportScene scene(isLevel ? level : grid(5, 5, 0.1, 0.1), isLevel ? kDown : btVector3(0, 0, 0));
    scene.wetAtRandom(4);
    const unsigned long long revision = scene.cloth().water().revision();
    scene.cloth().add<Seepage>({1e-3, 3});
    scene.run(10, 1);
    EXPECT_EQ(scene.cloth().water().revision(), revision) << isLevel;
  }
}

TEST(Seepage, ReversedGravityIsTheMirrorImage) {
  const auto run = [](bool isUp) {
    Mesh mesh = grid(7, 7, 0.1, 0.1, 0.3);
    for (btVector3& p : mesh.points) p.setY(isUp ? -p.y() : p.y());
    TransportScene scene(mesh, isUp ? -kDown : kDown);
    scene.wetAtRandom(6);
    scene.cloth().add<Seepage>({1e-3, 3});
    scene.run(50, 1);
    std::vector<double> saturations;
    for (int i = 0; i < scene.count(); ++i) saturations.push_back(scene.s(i));
    return saturations;
  };
  EXPECT_EQ(run(true), run(false));
}

// On a slope of 30 degrees it flows half as fast as on a wall, and with twice the gravity as fast again.
TEST(Seepage, FollowsThePresentSlopeAndGravity) {
  const auto centreAfter = [](double degrees, double gravity) {
    TransportScene scene(grid(3, 41, 0.05, 1), kDown * btScalar(gravity));
    scene.wet([](double, double y) { return std::fabs(y - 0.6) < 0.11 ? 0.5 : 0.0; });
    std::vector<double> along;
    for (int i = 0; i < scene.count(); ++i) along.push_back(scene.y(i));
    scene.cloth().add<Seepage>({1e-3, 1});
    const double angle = degrees * kPi / 180;
    for (int i = 0; i < scene.count(); ++i) {
      const double y = along[std::size_t(i)];
      scene.node(i).m_x =
          btVector3(scene.node(i).m_x.x(), btScalar(y * std::sin(angle)), btScalar(y * std::cos(angle)));
    }
    scene.run(200, 1);
    double moment = 0;
    for (int i = 0; i < scene.count(); ++i) moment += scene.cloth().held(i) * (along[std::size_t(i)] - 0.6);
    return moment / scene.cloth().ledger().held;
  };
  // Positions are rounded.
  EXPECT_NEAR(centreAfter(90, 1), -0.2, 1e-4);
  EXPECT_NEAR(centreAfter(30, 1), -0.1, 1e-4);
  EXPECT_NEAR(centreAfter(30, 2), -0.2, 1e-4);
  EXPECT_NEAR(centreAfter(-30, 1), 0.1, 1e-4);
}

// c D s^m ds/dz = c v s^n, z down: with n = 1, m = 0 an exponential.
TEST(SeepageAndDiffusion, BalanceInAnExponentialProfile) {
  const int n = 81;
  const double height = 0.2;
  TransportScene scene(grid(3, n, 2 * height / (n - 1), height), kDown);
  scene.wet([](double, double) { return 0.2; });
  const double v = 2e-4;
  const double d = 1e-5;
  scene.cloth().add<Seepage>({v, 1});
  Diffusion::Parameters wicking;
  wicking.exponent = 0;
  wicking.warpDiffusivity = wicking.weftDiffusivity = d;
  scene.cloth().add<Diffusion>(wicking);
  scene.run(8000, 0.5);
  for (int j = 0; j < n; ++j) {
    const double y = height * j / (n - 1);
    // The integral over the height is what was put in.
    const double bottom = 0.2 * height * v / d / (1 - std::exp(-height * v / d));
    // Upwind adds v h / 2 = 2.5e-7 to D: 2.5 % of the exponent, which is at most 4.
    EXPECT_NEAR(meanSaturationAt(scene, y) / (bottom * std::exp(-y * v / d)), 1, 0.09) << y;
  }
}

// With m = 1, n = 3: D ds/dz = v s^2, so 1 / s = 1 / s_bottom + v y / D.
TEST(SeepageAndDiffusion, BalanceInANonlinearProfile) {
  const int n = 81;
  const double height = 0.2;
  TransportScene scene(grid(3, n, 2 * height / (n - 1), height), kDown);
  scene.wet([](double, double) { return 0.4; });
  const double v = 1e-4;
  const double d = 1e-5;
  scene.cloth().add<Seepage>({v, 3});
  Diffusion::Parameters wicking;
  wicking.warpDiffusivity = wicking.weftDiffusivity = d;
  wicking.exponent = 1;
  scene.cloth().add<Diffusion>(wicking);
  scene.run(16000, 0.5);
  // From the integral over the height, D / v log(1 + v s_bottom height / D).
  const double bottom = std::expm1(0.4 * height * v / d) / (height * v / d);
  for (int j = 0; j < n; ++j) {
    const double y = height * j / (n - 1);
    // Upwind adds v s h / 2 D = 1.2 % to D.
    EXPECT_NEAR(meanSaturationAt(scene, y) * (1 / bottom + v * y / d), 1, 0.02) << y;
  }
}

// Of water that stands at the lower end, whatever the exponent: exp(-z / height).
TEST(SeepageAndDiffusion, InBalanceFallExponentiallyOverTheirHeight) {
  for (const double exponent : {1.0, 2.0, 4.0}) {
    const int n = 61;
    const double length = 0.1;
    TransportScene scene(grid(3, n, 2 * length / (n - 1), length), kDown);
    Diffusion::Parameters wicking;
    wicking.weftDiffusivity = wicking.warpDiffusivity = 4e-5;
    wicking.exponent = exponent;
    scene.wet([](double, double y) { return std::exp(-y / 0.05) * 0.7; });
    scene.cloth().add<Diffusion>(wicking);
    scene.cloth().add<Seepage>(wetcloth::seepageInBalance(wicking, 0.05));
    scene.run(500, 0.2);
    // Effects act one after the other, which shows in the half cells at both ends.
    const double from = length / 6;
    for (int j = (n - 1) / 6; j < n - 1; ++j) {
      const double y = length * j / (n - 1) - from;
      // Upwind takes s^(m + 1) of the upper end: half a spacing's share of (m + 1) / height of the exponent too much.
      const double upwind = (exponent + 1) * length / (n - 1) / 2 / 0.05 * y / 0.05;
      const double relative = meanSaturationAt(scene, y + from) / meanSaturationAt(scene, from);
      EXPECT_NEAR(std::log(relative), -y / 0.05, 1.3 * upwind + 0.01) << y << ' ' << exponent;
    }
  }
}

TEST(SeepageInBalance, IsTheDefaultOfTheDefault) {
  const Seepage::Parameters parameters = wetcloth::seepageInBalance({}, 0.1);
  EXPECT_NEAR(parameters.speed / Seepage::Parameters().speed, 1, 1e-15);
  EXPECT_EQ(parameters.exponent, Seepage::Parameters().exponent);
}

TEST(SeepageInBalance, BadInputIsNamed) {
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_EQ(rejection([&] { wetcloth::seepageInBalance({}, bad); }).find("seepageInBalance.height = "), 0u);
  }
  Diffusion::Parameters wicking;
  wicking.warpDiffusivity = -1;
  EXPECT_EQ(rejection([&] { wetcloth::seepageInBalance(wicking, 0.1); }).find("Diffusion.warpDiffusivity = -1"), 0u);
}

TEST(Seepage, HoldsOnHardMeshesForAnyStep) {
  for (const auto& [name, mesh] : hardMeshes()) {
    for (const double dt : {1e-6, 1.0, 1e6}) {
      TransportScene scene(mesh, btVector3(3, btScalar(-9.81), 1));
      scene.wetAtRandom(5);
      const double before = heldBy(scene);
      scene.cloth().add<Seepage>({1e-3, 3});
      scene.run(5, dt);
      EXPECT_GE(scene.lowest(), 0) << name << ' ' << dt;
      EXPECT_LE(scene.highest(), 1 + 1e-15) << name << ' ' << dt;
      EXPECT_NEAR(heldBy(scene), before, 1e-13 * before) << name << ' ' << dt;
      EXPECT_LE(std::fabs(scene.cloth().ledger().imbalance()), 1e-15 * before);
    }
  }
}

}  // namespace
}  // namespace wetcloth_test::seepage_test
