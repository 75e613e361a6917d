// SPDX-License-Identifier: Zlib
// A cloth that soaks gets heavier, softer and shorter, all in one run, and is itself again once it has dried.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "bullet_wetcloth/effects/Swelling.h"
#include "bullet_wetcloth/effects/WetStiffness.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"

#include <cmath>
#include <vector>

namespace wetcloth_test::soak_soften_shrink_test {

namespace {

using wetcloth::Absorption;
using wetcloth::HookeSprings;
using wetcloth::Swelling;
using wetcloth::WetCloth;
using wetcloth::WetStiffness;

constexpr double kDryStiffness = 60;  // [N/m]
constexpr double kWetFactor = 0.5;
constexpr double kShrinkage = 0.02;
constexpr double kRounding = kIsDouble ? 1e-14 : 1e-6;

/// Loses 1 / 200 of its capacity in a step, once told to.
void addDrying(WetCloth& cloth, const bool& dries) {
  addCall(
      cloth,
      [&dries](WetCloth& self, const wetcloth::Step&) {
        if (!dries) return;
        for (std::size_t i = 0; i < self.water().size(); ++i) {
          self.water().evaporate(i, self.water().capacity(i) / 200);
        }
      },
      wetcloth::Stage::losses);
}

/// Lets the cloth come to rest: velocities lose 5 % a step.
void settle(BodyScene& scene, int steps) {
  for (int i = 0; i < steps; ++i) {
    scene.bullet().step(1);
    for (int k = 0; k < scene.body().m_nodes.size(); ++k) {
      scene.body().m_nodes[k].m_v *= btScalar(0.95);
      scene.body().m_nodes[k].m_vn *= btScalar(0.95);
    }
  }
}

struct Links {
  std::vector<btScalar> rest;
  std::vector<btScalar> squared;
  std::vector<btScalar> constants;
};

Links linksOf(const btSoftBody& body) {
  Links links;
  for (int k = 0; k < body.m_links.size(); ++k) {
    links.rest.push_back(body.m_links[k].m_rl);
    links.squared.push_back(body.m_links[k].m_c1);
    links.constants.push_back(body.m_links[k].m_c0);
  }
  return links;
}

// A rope of 6 links of 0.1 m and nodes of 0.01 kg: each link's length against l0 (1 - shrinkage s) + (weight below) /
// (K f(s)), dry, wet, and dry again.
TEST_IN_EVERY_WORLD(SoakSoftenShrink, HangingRopeThereAndBack) {
  constexpr int kLinks = 6;
  BodyScene scene(GetParam(), [](btSoftBodyWorldInfo& info) {
    std::unique_ptr<btSoftBody> rope(btSoftBodyHelpers::CreateRope(
        info, btVector3(0, 0, 0), btVector3(0, btScalar(-0.1 * kLinks), 0), kLinks - 1, 1));
    rope->setActivationState(DISABLE_DEACTIVATION);
    for (int i = 1; i <= kLinks; ++i) rope->setMass(i, btScalar(0.01));
    return rope;
  });
  wetcloth::WetClothWorld wet(scene.world());
  WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(0.84, 0.1)));
  bool dries = false;
  cloth.add<HookeSprings>(springsOf(kDryStiffness));
  cloth.add<Swelling>({-kShrinkage});
  cloth.add<WetStiffness>({kWetFactor, 1, 0.1, 2});
  Absorption& soak = cloth.add<Absorption>({0.0});
  addDrying(cloth, dries);
  const auto expectRope = [&](double saturation) {
    double below = 0;
    for (int k = kLinks - 1; k >= 0; --k) {
      below += 0.01 * (1 + 0.84 * saturation);
      const btSoftBody::Link& link = scene.body().m_links[k];
      const double stretch = below * 9.81 / (kDryStiffness * (1 - (1 - kWetFactor) * saturation));
      const double length = double((link.m_n[0]->m_x - link.m_n[1]->m_x).length());
      // 1 % of the stretch, as for the springs alone.
      EXPECT_NEAR(length, 0.1 * (1 - kShrinkage * saturation) + stretch, 0.01 * stretch) << k;
    }
  };
  settle(scene, 800);
  expectRope(0);
  const Links before = linksOf(scene.body());

  adjust(soak, [](auto& p) { p.exposure = 1.0; });
  settle(scene, 1600);  // 67 time constants
  ASSERT_NEAR(cloth.meanSaturation(), 1, 1e-12);
  expectRope(1);

  adjust(soak, [](auto& p) { p.exposure = 0.0; });
  dries = true;
  settle(scene, 1600);
  ASSERT_EQ(cloth.ledger().held, 0);
  expectRope(0);
  EXPECT_LE(std::fabs(cloth.ledger().imbalance()), 1e-12 * cloth.ledger().absorbed);
  const Links after = linksOf(scene.body());
  EXPECT_EQ(after.rest, before.rest);
  EXPECT_EQ(after.squared, before.squared);
  for (std::size_t k = 0; k < after.constants.size(); ++k) {
    // The masses have been 1 / (1 / m_im): one rounding.
    EXPECT_NEAR(double(after.constants[k]), double(before.constants[k]), kRounding * double(before.constants[k])) << k;
  }
}

// A patch by its corners, which soaks from one side.
TEST_IN_EVERY_WORLD(SoakSoftenShrink, PatchThereAndBack) {
  wetcloth::ClothPatch patch = hangingPatch(6);
  patch.pinnedEdges.clear();
  patch.pinnedCorners = {wetcloth::ClothPatch::Corner::topLeft, wetcloth::ClothPatch::Corner::topRight};
  BodyScene scene(GetParam(), patch);
  scene.body().setActivationState(DISABLE_DEACTIVATION);
  wetcloth::WetClothWorld wet(scene.world());
  WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(0.84, 0.1)));
  bool dries = false;
  Absorption& soak = cloth.add<Absorption>({0.0});
  addDrying(cloth, dries);
  Swelling& swelling = cloth.add<Swelling>();
  cloth.add<HookeSprings>(springsOf(200, 50));
  WetStiffness& stiffness = cloth.add<WetStiffness>({0.5, 0.3, 1, 5});
  settle(scene, 1200);
  const std::vector<btScalar> start = stateOf(scene.body());
  const Links before = linksOf(scene.body());

  adjust(soak, [](auto& p) {
    p.exposure = [](const btVector3& x, const btVector3&) { return double(x.x()) < 0.5 ? 1.0 : 0.2; };
  });
  settle(scene, 1200);
  EXPECT_GT(cloth.meanSaturation(), 0.9);
  EXPECT_GT(largestDifference(stateOf(scene.body()), start), 0.01);

  adjust(soak, [](auto& p) { p.exposure = 0.0; });
  dries = true;
  settle(scene, 1600);
  ASSERT_EQ(cloth.ledger().held, 0);
  EXPECT_EQ(linksOf(scene.body()).rest, before.rest);
  // What is left of the swinging after 1600 steps, 20 times less than what the water did.
  EXPECT_LT(largestDifference(stateOf(scene.body()), start), 5e-4);
  const long long swollen = swelling.linksVisited();
  const long long refreshes = cloth.linkConstants().refreshes();
  const long long damped = stiffness.linksVisited();
  scene.bullet().step(10);
  EXPECT_EQ(swelling.linksVisited(), swollen);
  EXPECT_EQ(cloth.linkConstants().refreshes(), refreshes);
  EXPECT_EQ(stiffness.linksVisited(), damped + 10 * scene.body().m_links.size()) << "damping alone";
}

}  // namespace
}  // namespace wetcloth_test::soak_soften_shrink_test
