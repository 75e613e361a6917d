// SPDX-License-Identifier: Zlib
// HookeSprings on a cloth whose links water softens: closed forms at rest, the order of adding, the factorisations.

#include "bullet_wetcloth/effects/WetStiffness.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/SoftBodies.h"

#include <cmath>
#include <vector>

namespace wetcloth_test::wet_stiffness_springs_test {
namespace {

using wetcloth::HookeSprings;
using wetcloth::WetStiffness;

constexpr double kGravity = 9.81;
constexpr int kLinks = 8;
constexpr double kLength = 0.1;     // of a link [m]
constexpr double kNodeMass = 0.01;  // [kg]
constexpr double kStiffness = 50;   // dry [N/m]

HookeSprings::Parameters springs(double stiffness, double bendingStiffness = 10) {
  HookeSprings::Parameters parameters;
  parameters.stiffness = stiffness;
  parameters.bendingStiffness = bendingStiffness;
  return parameters;
}

void settle(ClothScene& scene, double seconds = 4) {
  for (int i = 0; i < seconds / kSubstep; ++i) {
    scene.step(1);
    damp(scene.body(), 0.03);
  }
}

double extension(const btSoftBody& body, int link) {
  return double((body.m_links[link].m_n[0]->m_x - body.m_links[link].m_n[1]->m_x).length()) - kLength;
}

// As for a dry chain (HookeSpringsStatics): what is left of the fall is 1e-3 of it, and float32 knows 0.8 m to 3e-5 of
// the smallest extension.
TEST_IN_EVERY_WORLD(WetStiffnessSprings, HangingChainStretchesByItsWeightOverTheSoftenedStiffness) {
  for (double wet : {0.5, 2.0}) {
    ClothScene scene(GetParam(), kEarthGravity, hangingRope(kLinks, kLength, kNodeMass));
    scene.cloth().add<HookeSprings>(springs(kStiffness));
    scene.cloth().add<WetStiffness>({wet, 1});
    scene.cloth().setSaturation(1);
    settle(scene);
    double below = 0;
    for (int link = kLinks - 1; link >= 0; --link) {
      below += kNodeMass * 1.84;
      EXPECT_NEAR(extension(scene.body(), link) / (below * kGravity / (wet * kStiffness)), 1, 0.01) << link;
    }
  }
}

TEST_IN_EVERY_WORLD(WetStiffnessSprings, EachLinkGoesByItsOwnNodes) {
  ClothScene scene(GetParam(), kEarthGravity, hangingRope(kLinks, kLength, kNodeMass));
  scene.cloth().add<HookeSprings>(springs(kStiffness));
  scene.cloth().add<WetStiffness>({0.4, 1});
  std::vector<double> held;
  for (int i = 0; i <= kLinks; ++i) held.push_back(scene.cloth().capacity(i) * i / kLinks);
  scene.cloth().setHeld(held);
  settle(scene);
  double below = 0;
  for (int link = kLinks - 1; link >= 0; --link) {
    below += 1 / double(scene.node(link + 1).m_im);
    const double factor = 1 - 0.6 * (link + 0.5) / kLinks;
    EXPECT_NEAR(extension(scene.body(), link) / (below * kGravity / (factor * kStiffness)), 1, 0.01) << link;
  }
}

// The forces follow every change of K, however seldom the matrix does: a chain that soaked step by step ends where one
// that was wet from the start does.
TEST_IN_EVERY_WORLD(WetStiffnessSprings, ChainThatSoaksWhileItHangsEndsAtTheClosedForm) {
  ClothScene scene(GetParam(), kEarthGravity, hangingRope(kLinks, kLength, kNodeMass));
  scene.cloth().add<HookeSprings>(springs(kStiffness));
  scene.cloth().add<WetStiffness>({0.5, 1});
  wetcloth::Absorption::Parameters ramp;
  ramp.law = wetcloth::Absorption::Law::ramp;
  ramp.rampDuration = 1;
  scene.cloth().add<wetcloth::Absorption>(ramp);
  settle(scene, 4);
  double below = 0;
  for (int link = kLinks - 1; link >= 0; --link) {
    below += kNodeMass * 1.84;
    EXPECT_NEAR(extension(scene.body(), link) / (below * kGravity / (0.5 * kStiffness)), 1, 0.01) << link;
  }
}

TEST_IN_EVERY_WORLD(WetStiffnessSprings, AStripThatIsHeldAtOneEndDroopsMoreWhenItsBendingIsSoftened) {
  const auto droop = [](double wetBending) {
    wetcloth::ClothPatch patch;
    patch.columns = 8;
    patch.rows = 3;
    patch.edgeU = btVector3(btScalar(0.35), 0, 0);
    patch.edgeV = btVector3(0, 0, btScalar(0.1));
    for (int j = 0; j < 3; ++j) {
      patch.pinnedNodes.push_back(patch.node(0, j));
      patch.pinnedNodes.push_back(patch.node(1, j));
    }
    ClothScene scene(GetParam(), kEarthGravity, patch);
    scene.cloth().add<HookeSprings>(springs(5000, 2000));
    scene.cloth().add<WetStiffness>({1, wetBending});
    scene.cloth().setSaturation(1);
    settle(scene, 3);
    return -double(scene.node(patch.node(7, 1)).m_x.y());
  };
  const double limp = droop(0.2);
  const double stiff = droop(1);
  EXPECT_GT(stiff, 0.01);  // it does bend
  EXPECT_GT(limp, 1.1 * stiff);
  EXPECT_LT(limp, 0.35);
}

TEST_IN_EVERY_WORLD(WetStiffnessSprings, LoseTheirSofteningWithTheEffect) {
  ClothScene scene(GetParam(), kEarthGravity, hangingRope(kLinks, kLength, kNodeMass));
  scene.cloth().add<HookeSprings>(springs(kStiffness));
  WetStiffness& effect = scene.cloth().add<WetStiffness>({0.25, 1});
  scene.cloth().setSaturation(1);
  settle(scene, 1);
  scene.cloth().remove(effect);
  settle(scene);
  EXPECT_NEAR(extension(scene.body(), 0) / (kLinks * 1.84 * kNodeMass * kGravity / kStiffness), 1, 0.01);
}

TEST_IN_EVERY_WORLD(WetStiffnessSprings, FactorTheirMatrixSeldom) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(5, 1));
  HookeSprings& effect = scene.cloth().add<HookeSprings>();
  scene.cloth().add<WetStiffness>({0.5, 0.25});
  wetcloth::Absorption::Parameters ramp;
  ramp.law = wetcloth::Absorption::Law::ramp;
  ramp.rampDuration = 2;
  scene.cloth().add<wetcloth::Absorption>(ramp);
  scene.step(500);
  // At first, and when the bending stiffness has halved on its way to a quarter.
  EXPECT_EQ(effect.factorizations(), 2);
  const long long soaked = effect.factorizations();
  scene.step(100);
  EXPECT_EQ(effect.factorizations(), soaked);
}

// Water that weighs nothing to speak of, so that the stiffness alone calls for a new matrix; the old one would not
// bound springs that are fifty times as stiff, and they would explode.
TEST_IN_EVERY_WORLD(WetStiffnessSprings, FactorTheirMatrixWhenOnlyTheStiffnessChanged) {
  wetcloth::Fabric fabric;
  fabric.capacity = 1e-6;
  ClothScene scene(GetParam(), kEarthGravity, hangingRope(kLinks, kLength, kNodeMass), fabric);
  HookeSprings& effect = scene.cloth().add<HookeSprings>(springs(kStiffness));
  scene.cloth().add<WetStiffness>({50, 1});
  settle(scene, 1);
  const long long dry = effect.factorizations();
  scene.cloth().setSaturation(1);
  settle(scene, 1);
  EXPECT_EQ(effect.factorizations(), dry + 1);
  // float32 knows the length to 1e-8 m, the first link's extension is 3e-4 m.
  EXPECT_NEAR(extension(scene.body(), 0) / (kLinks * kNodeMass * kGravity / (50 * kStiffness)), 1, 0.01);
}

TEST_IN_EVERY_WORLD(WetStiffnessSprings, GoOnAfterACut) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(6, 1));
  scene.wet().setLog({});
  scene.cloth().add<HookeSprings>(springs(200));
  scene.cloth().add<WetStiffness>({0.5, 0.2, 1, 5});
  scene.cloth().setSaturation(1);
  scene.step(10);
  ASSERT_TRUE(scene.body().cutLink(scene.body().m_faces[0].m_n[0], scene.body().m_faces[0].m_n[1], btScalar(0.5)));
  scene.step(60);
  EXPECT_EQ(scene.cloth().effects().size(), 2u);
  for (int i = 0; i < scene.body().m_nodes.size(); ++i) {
    EXPECT_TRUE(std::isfinite(double(scene.node(i).m_x.length2()))) << i;
  }
  EXPECT_EQ(int(scene.cloth().linkConstants().stiffness().size()), scene.body().m_links.size());
}

TEST_IN_POSITION_BASED_WORLDS(WetStiffnessOrder, OfAddingDoesNotMatter) {
  const auto heights = [](bool springsFirst) {
    ClothScene scene(GetParam(), kEarthGravity, hangingRope(kLinks, kLength, kNodeMass));
    if (springsFirst) scene.cloth().add<HookeSprings>(springs(kStiffness));
    scene.cloth().add<WetStiffness>({0.5, 0.5, 0.1, 1});
    if (!springsFirst) scene.cloth().add<HookeSprings>(springs(kStiffness));
    scene.cloth().add<wetcloth::Absorption>();
    scene.step(120);
    std::vector<btScalar> all;
    for (int i = 0; i <= kLinks; ++i) all.push_back(scene.node(i).m_x.y());
    return all;
  };
  EXPECT_EQ(heights(true), heights(false));
}

}  // namespace
}  // namespace wetcloth_test::wet_stiffness_springs_test
