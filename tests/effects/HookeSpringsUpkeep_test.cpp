// SPDX-License-Identifier: Zlib
// What the springs take from the body and give back, how often they factor their matrix, what they refuse.

#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"
#include "tests/support/SoftBodies.h"

#include <cmath>
#include <limits>
#include <vector>

namespace wetcloth_test::hooke_springs_upkeep_test {
namespace {

using wetcloth::HookeSprings;

struct LinkState {
  btSoftBody::Material* material;
  btScalar c0;
  btScalar c1;
  btScalar restLength;
  bool isBending;
};

std::vector<LinkState> linksOf(const btSoftBody& body) {
  std::vector<LinkState> links;
  for (int i = 0; i < body.m_links.size(); ++i) {
    const btSoftBody::Link& link = body.m_links[i];
    links.push_back({link.m_material, link.m_c0, link.m_c1, link.m_rl, link.m_bbending != 0});
  }
  return links;
}

TEST_IN_EVERY_WORLD(HookeSpringsUpkeep, RemovingThemGivesTheLinksBackAsTheyWere) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(6, 1));
  scene.step(1);
  const std::vector<LinkState> before = linksOf(scene.body());
  HookeSprings& effect = scene.cloth().add<HookeSprings>();
  scene.step(20);
  scene.cloth().remove(effect);
  const std::vector<LinkState> after = linksOf(scene.body());
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after[i].material, before[i].material) << i;
    EXPECT_EQ(after[i].c0, before[i].c0) << i;
    EXPECT_EQ(after[i].c1, before[i].c1) << i;
    EXPECT_EQ(after[i].restLength, before[i].restLength) << i;
    EXPECT_EQ(after[i].isBending, before[i].isBending) << i;
  }
}

TEST_IN_EVERY_WORLD(HookeSpringsUpkeep, LinksComeBackWithTheMassesOfTheWetCloth) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(6, 1));
  scene.step(1);
  const std::vector<LinkState> dry = linksOf(scene.body());
  HookeSprings& effect = scene.cloth().add<HookeSprings>();
  scene.cloth().setSaturation(1);
  scene.step(5);
  scene.cloth().remove(effect);
  // m_c0 = (sum of the inverse masses) / stiffness: 1.84 times the mass on both ends.
  const std::vector<LinkState> wet = linksOf(scene.body());
  for (std::size_t i = 0; i < dry.size(); ++i) EXPECT_NEAR(wet[i].c0 / dry[i].c0, 1 / 1.84, 1e-5) << i;
}

TEST_IN_EVERY_WORLD(HookeSpringsUpkeep, RemovedBeforeTheFirstStepTheyLeaveNoTrace) {
  const auto positions = [](bool addAndRemove) {
    ClothScene scene(GetParam(), kEarthGravity, hangingRope(8, 0.1, 0.01));
    if (addAndRemove) scene.cloth().remove(scene.cloth().add<HookeSprings>());
    scene.step(60);
    std::vector<btScalar> heights;
    for (int i = 0; i <= 8; ++i) heights.push_back(scene.node(i).m_x.y());
    return heights;
  };
  EXPECT_EQ(positions(true), positions(false));
}

TEST_IN_EVERY_WORLD(HookeSpringsUpkeep, FactorsNothingWhileNothingChanges) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(6, 1));
  HookeSprings& effect = scene.cloth().add<HookeSprings>();
  scene.step(2);
  const long long once = effect.factorizations();
  EXPECT_GE(once, 1);
  EXPECT_LE(once, 2);
  scene.step(240);
  EXPECT_EQ(effect.factorizations(), once);
}

// 1.84 times the mass, and 1.84 times less.
TEST_IN_EVERY_WORLD(HookeSpringsUpkeep, FactorsOnceWhileTheClothSoaksAndDries) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(6, 1));
  HookeSprings& effect = scene.cloth().add<HookeSprings>();
  for (int step = 0; step <= 480; ++step) {
    scene.cloth().setSaturation(1 - std::fabs(step / 240.0 - 1));
    scene.step(1);
  }
  EXPECT_EQ(effect.factorizations(), 1);
}

TEST_IN_EVERY_WORLD(HookeSpringsUpkeep, FactorsOnceWhileStiffnessesStayWithinHalfAndTwice) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(6, 1));
  HookeSprings& effect = scene.cloth().add<HookeSprings>();
  scene.step(1);
  HookeSprings::Parameters parameters = effect.parameters();
  for (const double factor : {1.9, 0.55}) {
    parameters.stiffness = 1000 * factor;
    effect.setParameters(parameters);
    scene.step(5);
    EXPECT_EQ(effect.factorizations(), 1) << factor;
  }
  parameters.stiffness = 1000 * 2.1;
  effect.setParameters(parameters);
  scene.step(5);
  EXPECT_EQ(effect.factorizations(), 2);
}

TEST_IN_EVERY_WORLD(HookeSpringsUpkeep, FactorsAnewWhenTheStepChanges) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(6, 1));
  HookeSprings& effect = scene.cloth().add<HookeSprings>();
  scene.step(5, 1.0 / 240);
  const long long before = effect.factorizations();
  scene.step(5, 1.0 / 60);
  EXPECT_EQ(effect.factorizations(), before + 1);
}

TEST(HookeSpringsInPositionBasedWorlds, BulletsLinksPullAgainAfterRemoval) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, hangingRope(8, 0.1, 0.01));
  HookeSprings::Parameters soft;
  soft.stiffness = 10;
  HookeSprings& effect = scene.cloth().add<HookeSprings>(soft);
  for (int i = 0; i < 480; ++i) {
    scene.step(1);
    damp(scene.body(), 0.03);
  }
  EXPECT_LT(scene.node(8).m_x.y(), -1.1);  // 36 m g / k = 0.35 m longer than at rest
  scene.cloth().remove(effect);
  for (int i = 0; i < 480; ++i) {
    scene.step(1);
    damp(scene.body(), 0.03);
  }
  // The rope snaps back and may end folded along its own line; its links have their lengths again.
  for (int i = 0; i < 8; ++i) EXPECT_NEAR((scene.node(i).m_x - scene.node(i + 1).m_x).length(), 0.1, 0.01) << i;
}

TEST(HookeSpringsInput, BadParametersAreNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (double bad : {0.0, -1.0, nan, infinite}) {
    HookeSprings::Parameters parameters;
    parameters.stiffness = bad;
    EXPECT_NE(rejection([&] { HookeSprings{parameters}; }).find("stiffness"), std::string::npos) << bad;
  }
  for (double bad : {-1.0, nan, infinite}) {
    HookeSprings::Parameters parameters;
    parameters.bendingStiffness = bad;
    EXPECT_NE(rejection([&] { HookeSprings{parameters}; }).find("bendingStiffness"), std::string::npos) << bad;
    HookeSprings::Parameters perLink;
    perLink.perLink = {1, bad, 1};
    EXPECT_NE(rejection([&] { HookeSprings{perLink}; }).find("perLink[1]"), std::string::npos) << bad;
  }
  for (int bad : {0, -3}) {
    HookeSprings::Parameters parameters;
    parameters.iterations = bad;
    EXPECT_NE(rejection([&] { HookeSprings{parameters}; }).find("iterations"), std::string::npos) << bad;
  }
}

TEST(HookeSpringsInput, PerLinkNeedsOneValuePerLink) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, hangingRope(8, 0.1, 0.01));
  HookeSprings::Parameters parameters;
  parameters.perLink.assign(7, 100.0);
  EXPECT_NE(rejection([&] { scene.cloth().add<HookeSprings>(parameters); }).find("perLink"), std::string::npos);
  EXPECT_TRUE(scene.cloth().effects().empty());
}

// A second one would take the first one's powerless links for the body's own, and give those back last.
TEST(HookeSpringsInput, ASecondOnOneClothIsRefused) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, levelPatch(4, 1));
  const btSoftBody::Material* const own = scene.body().m_links[0].m_material;
  HookeSprings& effect = scene.cloth().add<HookeSprings>();
  EXPECT_NE(rejection([&] { scene.cloth().add<HookeSprings>(); }).find("already"), std::string::npos);
  scene.cloth().remove(effect);
  EXPECT_EQ(scene.body().m_links[0].m_material, own);
}

TEST(HookeSpringsInput, BodyWithoutLinksIsRefused) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity,
                   triangles({btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 0, 1)}, {1, 1, 1}, {{0, 1, 2}}));
  EXPECT_NE(rejection([&] { scene.cloth().add<HookeSprings>(); }).find("link"), std::string::npos);
  scene.step(10);
  EXPECT_TRUE(std::isfinite(double(scene.node(0).m_x.y())));
}

}  // namespace
}  // namespace wetcloth_test::hooke_springs_upkeep_test
