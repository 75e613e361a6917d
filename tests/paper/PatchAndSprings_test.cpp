// SPDX-License-Identifier: Zlib
// Basori et al. 2017, claims S1 to S3 and S12: the patch, its springs, gravity, and the stretch of the wet cloth.

#include "tests/paper/PaperCloth.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/Measures.h"
#include "tests/support/SoftBodies.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace wetcloth_test::patch_and_springs_test {
namespace {

using wetcloth::ClothPatch;
using wetcloth::Fabric;
using wetcloth::HookeSprings;

constexpr double kGravity = 9.81;

void settle(ClothScene& scene, int steps, double share = 0.03) {
  for (int i = 0; i < steps; ++i) {
    scene.step(1);
    damp(scene.body(), share);
  }
}

double length(const btSoftBody& body, int link) {
  return double((body.m_links[link].m_n[0]->m_x - body.m_links[link].m_n[1]->m_x).length());
}

// III.A: mechanical (i,j)-(i+1,j), (i,j)-(i,j+1); shear on both diagonals; flexion (i,j)-(i+2,j), (i,j)-(i,j+2).
TEST(PaperSprings, S1_PatchOf32By32Has5826Springs) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, paperPatch(), Fabric::tableII());
  const btSoftBody& body = scene.body();
  EXPECT_EQ(body.m_links.size(), 5826);
  std::array<int, 3> counts = {0, 0, 0};
  const double cell = 1 / std::sqrt(1000.0);
  const double lengths[] = {cell, cell * std::sqrt(2.0), 2 * cell};
  for (int i = 0; i < body.m_links.size(); ++i) {
    for (int kind = 0; kind < 3; ++kind) {
      if (std::fabs(double(body.m_links[i].m_rl) - lengths[kind]) < 1e-5) ++counts[std::size_t(kind)];
    }
  }
  EXPECT_EQ(counts, (std::array<int, 3>{1984, 1922, 1920}));
}

// IV.C, Eq. 5: F = K U, with K and l0 for each spring by itself (Eq. 6).
TEST(PaperSprings, S2_EachSpringHasItsOwnStiffnessAndRestLength) {
  EXPECT_NEAR(wetcloth::hookeForce(btVector3(0, 0, 0), btVector3(0, btScalar(-1.5), 0), 1, 8).y(), -4, 1e-5);

  ClothScene scene(WorldKind::softRigid, kEarthGravity, hangingRope(3, 0.2, 0.01));
  HookeSprings::Parameters parameters;
  parameters.perLink = {30, 20, 10};
  scene.cloth().add<HookeSprings>(parameters);
  settle(scene, 960);
  const double weight = 0.01 * kGravity;
  // 1 % is what the fall leaves after 4 s of damping.
  EXPECT_NEAR((length(scene.body(), 0) - 0.2) / (3 * weight / 30), 1, 0.01);
  EXPECT_NEAR((length(scene.body(), 1) - 0.2) / (2 * weight / 20), 1, 0.01);
  EXPECT_NEAR((length(scene.body(), 2) - 0.2) / (1 * weight / 10), 1, 0.01);
}

// IV.D, Eq. 7: F = M g with the wet mass; IV.B, Eq. 4: a = F / M. A node of 0.01 g and of 0.84 g on one spring.
TEST(PaperSprings, S3_GravityPullsWithTheWetMass) {
  for (WorldKind world : kAllWorlds) {
    const auto weight = [&](double saturation) {
      ClothScene scene(world, kEarthGravity, hangingRope(1, 0.1, 0.01 * kGram), Fabric::tableII());
      HookeSprings::Parameters parameters;
      parameters.stiffness = 0.5;
      scene.cloth().add<HookeSprings>(parameters);
      scene.cloth().setSaturation(saturation);
      settle(scene, 960);
      return 0.5 * (length(scene.body(), 0) - 0.1);
    };
    EXPECT_NEAR(weight(0) / (0.01 * kGram * kGravity), 1, 0.01) << world;
    EXPECT_NEAR(weight(1) / (0.84 * kGram * kGravity), 1, 0.01) << world;

    // and so, in a vacuum, all of them fall alike
    for (double saturation : {0.0, 1.0}) {
      ClothScene scene(world, kEarthGravity, paperPatch(8), Fabric::tableII());
      scene.cloth().setSaturation(saturation);
      scene.step(240);
      EXPECT_NEAR(-centreOfMass(scene.body())[1], kGravity / 2, kGravity * kSubstep) << world;
    }
  }
}

// IV.G, Fig. 15: the springs of the saturated cloth stretch more under the new masses: 84 times the mass, 84 times the
// stretch. Bullet's own links in the position-based worlds do not; HookeSprings does, in every world.
TEST(PaperSprings, S12_SaturatedSpringsStretch84TimesAsMuch) {
  for (WorldKind world : kAllWorlds) {
    const auto stretch = [&](double saturation) {
      const ClothPatch patch = hangingPaperPatch(12);
      ClothScene scene(world, kEarthGravity, patch, Fabric::tableII());
      HookeSprings::Parameters parameters;
      parameters.stiffness = parameters.bendingStiffness = 20;
      scene.cloth().add<HookeSprings>(parameters);
      scene.cloth().setSaturation(saturation);
      settle(scene, 720);
      const btSoftBody& body = scene.body();
      return double(body.m_nodes[patch.node(6, 0)].m_x.y() - body.m_nodes[patch.node(6, 11)].m_x.y()) -
             11 / std::sqrt(1000.0);
    };
    const double dry = stretch(0);
    // 5 %: 84 times the stretch is 3 % of the length, where the diagonals have begun to turn.
    EXPECT_NEAR(stretch(1) / dry / 84, 1, 0.05) << world;
  }
}

}  // namespace
}  // namespace wetcloth_test::patch_and_springs_test
