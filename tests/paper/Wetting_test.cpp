// SPDX-License-Identifier: Zlib
// Basori et al. 2017, claims S4 to S6 and S9: how the cloth takes up water, and how it darkens.

#include "tests/paper/PaperCloth.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wetcloth_test::wetting_test {
namespace {

using wetcloth::Absorption;
using wetcloth::Fabric;
using wetcloth::Hook;

// III.B: m += dt dm/dt (Eq. 1) with dQ/dt = (alpha / theta) exp(-t / theta) (Eq. 3) makes Q = alpha (1 - exp(-t/theta))
// (Eq. 2). Written in w, Eq. 3 is dw/dt = (C - w) / theta, and Eq. 1 is its forward Euler.
TEST(PaperWetting, S4_ForwardEulerOfEquation1FollowsEquation2) {
  Absorption::Parameters parameters;
  parameters.law = Absorption::Law::forwardEuler;
  parameters.conservesMomentum = false;
  const double alpha = 0.84;
  const double theta = 8.844;

  ClothScene first(WorldKind::softRigid, kEarthGravity, paperPatch(8), Fabric::cotton(), Hook::manual);
  first.cloth().add<Absorption>(parameters);
  first.preTick(0.0625);
  EXPECT_NEAR(first.cloth().held(27) / first.cloth().dryMass(27), 0.0625 * alpha / theta, 1e-14);  // Eq. 3 at t = 0

  ClothScene scene(WorldKind::softRigid, kEarthGravity, paperPatch(8), Fabric::cotton());
  scene.cloth().add<Absorption>(parameters);
  scene.step(10 * 256, kExactSubstep);
  const double share = -std::expm1(-10 / theta);
  EXPECT_NEAR(share, 0.677, 0.0005);
  // First order: dt / (2 theta) x t / theta x exp(-t / theta) = 8e-5 at 10 s.
  EXPECT_NEAR(scene.cloth().saturation(27), share, 1e-4);
  EXPECT_GT(std::fabs(scene.cloth().saturation(27) - share), 1e-5);  // it is Euler, not the exact law
}

// IV.G, Table I, its two rows unswapped.
TEST(PaperWetting, S5_ThreeFabricsTakeUpTableI) {
  struct Row {
    Fabric fabric;
    double alpha, theta, afterTenSeconds;
  };
  const Row rows[] = {{Fabric::cotton(), 0.84, 8.844, 0.677},
                      {Fabric::coarseWool(), 1.24, 4.8936, 0.870},
                      {Fabric::highAbsorption(), 2.492, 3.3803, 0.948}};
  for (const Row& row : rows) {
    ClothScene scene(WorldKind::softRigid, kEarthGravity, paperPatch(8), row.fabric);
    scene.cloth().add<Absorption>();
    scene.step(2400);
    EXPECT_NEAR(scene.cloth().meanSaturation(), row.afterTenSeconds, 0.0005) << row.fabric.name;
    scene.step(240 * 60);  // 7 time constants of cotton and more
    EXPECT_NEAR(scene.cloth().ledger().held / (scene.cloth().totalMass() - scene.cloth().ledger().held), row.alpha,
                1e-3 * row.alpha)
        << row.fabric.name;
  }
}

// IV.G, Table II: from 0.01 g in ten steps of 0.083 g to 0.84 g; a saturated node takes no more.
TEST(PaperWetting, S6_TenStepsFrom001To084Gram) {
  const double afterWetting[] = {0.093, 0.176, 0.259, 0.342, 0.425, 0.508, 0.591, 0.674, 0.757, 0.84};
  for (WorldKind world : kAllWorlds) {
    const wetcloth::ClothPatch patch = paperPatch(8);
    ClothScene scene(world, kEarthGravity, patch, Fabric::tableII());
    scene.cloth().add<Absorption>(Absorption::Parameters::paper());
    const int node = innerNode(patch);
    // 2e-7 g: float32 holds 0.84 g to 5e-8 g.
    EXPECT_NEAR(1 / double(scene.node(node).m_im) / kGram, 0.01, 2e-7) << world;
    for (double grams : afterWetting) {
      scene.step(256, kExactSubstep);
      EXPECT_NEAR(1 / double(scene.node(node).m_im) / kGram, grams, 2e-7) << world;
    }
    scene.step(256, kExactSubstep);
    EXPECT_NEAR(1 / double(scene.node(node).m_im) / kGram, 0.84, 2e-7) << world;
  }
}

// IV.H, Fig. 16: four shown stages up to the darkest at saturation, constant after.
TEST(PaperWetting, S9_DarkensInFourStagesAndThenNoMore) {
  const wetcloth::ClothPatch patch = paperPatch(8);
  ClothScene scene(WorldKind::softRigid, kEarthGravity, patch, Fabric::tableII());
  scene.cloth().add<Absorption>(Absorption::Parameters::paper());
  const int node = innerNode(patch);
  const wetcloth::Colour dry = {0.6, 0.6, 0.6};
  const auto brightness = [&] { return wetcloth::paperColour(dry, scene.cloth().saturation(node)).g; };
  const int stageAfterSecond[] = {1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4};
  const double darkest = wetcloth::wetAlbedo(0.6);
  EXPECT_EQ(brightness(), 0.6);
  for (int stage : stageAfterSecond) {
    scene.step(256, kExactSubstep);
    EXPECT_EQ(wetcloth::paperStage(scene.cloth().saturation(node)), stage);
    EXPECT_NEAR(brightness(), 0.6 + (darkest - 0.6) * stage / 4, 1e-12);
  }
  EXPECT_NEAR(darkest / 0.6, 0.76, 0.005);
}

}  // namespace
}  // namespace wetcloth_test::wetting_test
