// SPDX-License-Identifier: Zlib
// Diffusion never makes a node negative or over-full, and keeps water and momentum: any step, any mesh, any method.

#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"
#include "tests/support/TransportScene.h"

namespace wetcloth_test::diffusion_bounds_test {

using namespace transport;

namespace {

using wetcloth::Diffusion;
using Method = Diffusion::Method;

constexpr Method kMethods[] = {Method::factored, Method::conjugateGradients, Method::explicitSubsteps};

Diffusion::Parameters with(double diffusivity, double exponent = 0, Method method = Method::factored) {
  Diffusion::Parameters parameters;
  parameters.warpDiffusivity = diffusivity;
  parameters.weftDiffusivity = diffusivity / 3;
  parameters.exponent = exponent;
  parameters.method = method;
  return parameters;
}

double heldBy(TransportScene& scene) { return scene.cloth().ledger().held; }

TEST(DiffusionBounds, ObeysTheMaximumPrincipleForAnyStepOnAnyMesh) {
  for (const auto& [name, mesh] : hardMeshes()) {
    for (const double exponent : {0.0, 3.0}) {
      for (const double dt : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
        TransportScene scene(mesh);
        scene.wetAtRandom(5, 0.2, 0.8);
        const double lowest = scene.lowest();
        const double highest = scene.highest();
        const double before = heldBy(scene);
        scene.cloth().add<Diffusion>(with(1e-3, exponent));
        for (int n = 0; n < 5; ++n) {
          scene.preTick(dt);
          // The solver's rounding, in needles with conductances up to 1e9 times the capacity.
          EXPECT_GE(scene.lowest(), lowest - 1e-9) << name << ' ' << exponent << ' ' << dt;
          EXPECT_LE(scene.highest(), highest + 1e-9) << name << ' ' << exponent << ' ' << dt;
        }
        EXPECT_NEAR(heldBy(scene), before, 1e-13 * before) << name;
      }
    }
  }
}

TEST(DiffusionBounds, StaysBetweenEmptyAndFullByAnyMethod) {
  for (const Method method : kMethods) {
    for (const auto& [name, mesh] : hardMeshes()) {
      for (const double dt : {1e-6, 0.1, 1e6}) {
        TransportScene scene(mesh);
        scene.wet([](double x, double y) { return int(1000 * (x + 2 * y)) % 3 == 0 ? 1.0 : 0.0; });
        const double before = heldBy(scene);
        scene.cloth().add<Diffusion>(with(1e-2, 1, method));
        scene.run(3, dt);
        EXPECT_GE(scene.lowest(), 0) << name << ' ' << dt;
        EXPECT_LE(scene.highest(), 1 + 1e-15) << name << ' ' << dt;
        EXPECT_NEAR(heldBy(scene), before, 1e-13 * before) << name;
      }
    }
  }
}

TEST(DiffusionBounds, AnOverfullNodeOnlyDriesAndOverfillsNoOther) {
  for (const Method method : kMethods) {
    TransportScene scene(grid(5, 5, 0.1, 0.1));
    scene.wet([](double x, double y) { return x == 0 && y == 0 ? 5.0 : 0.9; });
    scene.cloth().add<Diffusion>(with(1e-4, 0, method));
    double last = 5;
    for (int n = 0; n < 200; ++n) {
      scene.preTick(0.05);
      EXPECT_LE(scene.s(0), last);
      last = scene.s(0);
      for (int i = 1; i < 25; ++i) EXPECT_LE(scene.s(i), 1 + 1e-15) << i;
    }
    EXPECT_LT(last, 4.9);
  }
}

TEST(DiffusionBounds, KeepsTheWaterOverTenThousandSteps) {
  TransportScene scene(grid(8, 8, 0.1, 0.1, 0.3));
  scene.wetAtRandom(3);
  const double before = heldBy(scene);
  scene.cloth().add<Diffusion>(with(1e-6, 1));
  scene.run(10000, 0.01);
  EXPECT_LT(scene.highest() - scene.lowest(), 0.8) << "it did something";
  EXPECT_GT(scene.highest() - scene.lowest(), 0.01) << "it was not idle all the time";
  const wetcloth::Ledger ledger = scene.cloth().ledger();
  EXPECT_NEAR(ledger.held, before, 1e-13 * before);
  EXPECT_LE(std::fabs(ledger.imbalance()), 1e-15 * before);
  EXPECT_EQ(ledger.absorbed, 0);
}

// Everything ends even: also for steps far longer than it takes.
TEST(DiffusionBounds, EndsEven) {
  for (const double dt : {1.0, 1e4, 1e6}) {
    TransportScene scene(grid(6, 6, 0.1, 0.1, 0.3));
    scene.wetAtRandom(3);
    const double mean = scene.cloth().meanSaturation();
    scene.cloth().add<Diffusion>(with(1e-3));
    scene.run(100, dt);
    EXPECT_NEAR(scene.lowest(), mean, 1e-9) << dt;
    EXPECT_NEAR(scene.highest(), mean, 1e-9) << dt;
  }
}

TEST_IN_EVERY_WORLD(DiffusionMomentum, IsKept) {
  for (const double dt : {1e-3, 1.0, 1e4}) {
    ClothScene scene(GetParam(), btVector3(0, 0, 0), levelPatch(6, 0.1), wetcloth::Fabric::highAbsorption(),
                     wetcloth::Hook::manual);
    std::vector<double> held;
    for (int i = 0; i < 36; ++i) held.push_back(i % 3 == 0 ? scene.cloth().capacity(i) : 0);
    scene.cloth().setHeld(held);
    for (int i = 0; i < 36; ++i) {
      scene.node(i).m_v = scene.node(i).m_vn = btVector3(btScalar(std::sin(i)), btScalar(i % 5), btScalar(2 - i % 4));
    }
    const auto before = momentum(scene.body());
    scene.cloth().add<Diffusion>(with(1e-4));
    for (int n = 0; n < 10; ++n) scene.preTick(dt);
    const auto after = momentum(scene.body());
    // 36 velocities of up to 4 m/s, rounded ten times.
    const double tolerance = (kIsDouble ? 1e-14 : 1e-6) * 4 * freeMass(scene.body());
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(after[k], before[k], tolerance) << dt;
    for (int i = 0; i < 36; ++i) {
      EXPECT_LE(std::fabs(scene.node(i).m_v.x()), 1 + 1e-6);
      EXPECT_LE(std::fabs(scene.node(i).m_v.y()), 4 + 1e-5);
      EXPECT_TRUE(!scene.bullet().isDeformable() || scene.node(i).m_v == scene.node(i).m_vn) << "it reads both";
    }
  }
}

// Wet nodes fly, dry ones rest: what spreads drags them along.
TEST_IN_EVERY_WORLD(DiffusionMomentum, WaterDragsAlongTheNodesItComesTo) {
  ClothScene scene(GetParam(), btVector3(0, 0, 0), levelPatch(3, 0.1), wetcloth::Fabric::cotton(),
                   wetcloth::Hook::manual);
  std::vector<double> held(9, 0.0);
  held[4] = scene.cloth().capacity(4);
  scene.cloth().setHeld(held);
  scene.node(4).m_v = scene.node(4).m_vn = btVector3(2, 0, 0);
  scene.cloth().add<Diffusion>(with(1e-4));
  scene.preTick(1e-3);
  EXPECT_EQ(scene.node(4).m_v.x(), 2) << "nothing came to it";
  const double arrived = scene.cloth().held(3);
  ASSERT_GT(arrived, 0);
  const double expected = 2 * arrived / (scene.cloth().dryMass(3) + arrived);
  // And D dt / h^2 = 4e-5 of it came and went on to the corners; the velocity is rounded.
  EXPECT_NEAR(scene.node(3).m_v.x(), expected, 1e-3 * expected);
}

// Water that lands and spreads in one step brings its momentum in that step.
TEST(DiffusionBounds, MomentumOfWhatArrivesInTheSameStepIsKept) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(5, 0.1), wetcloth::Fabric::cotton(),
                   wetcloth::Hook::manual);
  setVelocity(scene.body(), btVector3(1, 0, 0));
  scene.node(7).m_v = btVector3(-2, 1, 0);
  const auto before = momentum(scene.body());
  wetcloth::Absorption::Parameters soak;
  std::vector<double> exposure(25, 0.0);
  exposure[12] = exposure[3] = 1;
  soak.exposure = exposure;
  soak.waterVelocity = btVector3(0, -3, 0);
  scene.cloth().add<wetcloth::Absorption>(soak);
  scene.cloth().add<Diffusion>(with(1e-4));
  for (int n = 0; n < 20; ++n) scene.preTick(0.05);
  const auto after = momentum(scene.body());
  const double arrived = scene.cloth().ledger().absorbed;
  ASSERT_GT(arrived, 0);
  const double tolerance = (kIsDouble ? 1e-13 : 1e-5) * freeMass(scene.body());
  EXPECT_NEAR(after[0], before[0], tolerance);
  EXPECT_NEAR(after[1], before[1] - 3 * arrived, tolerance);
}

// A pinned node takes part, and is a wall for velocities.
TEST(DiffusionBounds, APinnedNodeHoldsWaterToo) {
  TransportScene scene(grid(3, 3, 0.1, 0.1));
  scene.node(4).m_im = 0;
  scene.wet([](double, double) { return 1; });
  std::vector<double> held(9, 0.0);
  held[4] = scene.cloth().capacity(4);
  scene.cloth().setHeld(held);
  setVelocity(scene.body(), btVector3(1, 0, 0));
  scene.cloth().add<Diffusion>(with(1e-4));
  scene.preTick(1);
  EXPECT_LT(scene.s(4), 0.95);
  EXPECT_GT(scene.s(3), 0.01);
  EXPECT_EQ(scene.node(4).m_v.x(), 0);
  EXPECT_LT(scene.node(3).m_v.x(), 1) << "what came from the pin was at rest";
  EXPECT_EQ(scene.node(4).m_im, 0);
}

}  // namespace
}  // namespace wetcloth_test::diffusion_bounds_test
