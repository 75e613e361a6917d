// SPDX-License-Identifier: Zlib
// What Swelling writes into the links, and what it gives back.

#include "bullet_wetcloth/effects/Swelling.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"
#include "tests/support/SoftBodies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace wetcloth_test::swelling_lengths_test {
namespace {

using wetcloth::Hook;
using wetcloth::Swelling;
using wetcloth::swellingStrain;

// One product, rounded.
constexpr double kRounding = kIsDouble ? 1e-15 : 1.2e-7;

struct Lengths {
  std::vector<btScalar> rest;
  std::vector<btScalar> squared;
  bool operator==(const Lengths& other) const { return rest == other.rest && squared == other.squared; }
};

Lengths lengthsOf(const btSoftBody& body) {
  Lengths lengths;
  for (int k = 0; k < body.m_links.size(); ++k) {
    lengths.rest.push_back(body.m_links[k].m_rl);
    lengths.squared.push_back(body.m_links[k].m_c1);
  }
  return lengths;
}

TEST(SwellingStrain, IsLinearInSaturation) {
  EXPECT_EQ(swellingStrain(0, -0.02), 0);
  EXPECT_EQ(swellingStrain(1, -0.02), -0.02);
  EXPECT_NEAR(swellingStrain(0.25, 0.08), 0.02, 1e-17);
}

TEST(SwellingInput, ABadStrainIsNamed) {
  for (double bad : {-0.5, 0.5, 7.0, std::numeric_limits<double>::quiet_NaN(), HUGE_VAL}) {
    EXPECT_EQ(rejection([&] { Swelling({bad}); }).find("Swelling.saturatedStrain = "), 0u) << bad;
    Swelling effect({0.1});
    EXPECT_NE(rejection([&] { adjust(effect, [&](auto& p) { p.saturatedStrain = bad; }); }), "") << bad;
    EXPECT_EQ(effect.parameters().saturatedStrain, 0.1);
  }
}

TEST(SwellingInput, ABodyWithoutLinksAndASecondOneAreRefused) {
  ClothScene points(WorldKind::softRigid, kEarthGravity,
                    triangles({btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 0, 1)}, {1, 1, 1}, {{0, 1, 2}}));
  EXPECT_NE(rejection([&] { points.cloth().add<Swelling>(); }).find("links"), std::string::npos);
  ClothScene scene(WorldKind::softRigid, kEarthGravity, levelPatch(4, 1));
  scene.cloth().add<Swelling>();
  EXPECT_NE(rejection([&] { scene.cloth().add<Swelling>(); }).find("already"), std::string::npos);
  EXPECT_EQ(scene.cloth().effects().size(), 1u);
}

TEST_IN_EVERY_WORLD(SwellingLengths, FollowEachLinksOwnSaturation) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(5, 1));
  scene.step(1);
  const Lengths dry = lengthsOf(scene.body());
  scene.cloth().add<Swelling>({-0.1});
  std::vector<double> held;
  for (int i = 0; i < 25; ++i) held.push_back(scene.cloth().capacity(i) * (i % 7) / 5.0);
  scene.cloth().setHeld(held);
  scene.step(1);
  for (int k = 0; k < scene.body().m_links.size(); ++k) {
    const btSoftBody::Link& link = scene.body().m_links[k];
    double saturation = 0;
    for (const btSoftBody::Node* node : link.m_n) {
      saturation += std::min(scene.cloth().saturation(int(node - &scene.node(0))), 1.0) / 2;  // over-full: saturated
    }
    const double natural = double(dry.rest[std::size_t(k)]);
    EXPECT_NEAR(double(link.m_rl), natural * (1 - 0.1 * saturation), kRounding) << k;
    EXPECT_EQ(link.m_c1, link.m_rl * link.m_rl) << k;
  }
}

// Saturations of a cycle: not round numbers, and not the same twice.
double saturationOfCycle(int cycle) { return 0.5 + 0.5 * std::sin(cycle * 0.7 + 0.1); }

TEST(SwellingReverses, TenThousandTimesBitForBit) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(4, 1), wetcloth::Fabric::cotton(),
                   Hook::manual);
  scene.step(1);
  const Lengths dry = lengthsOf(scene.body());
  scene.cloth().add<Swelling>({-0.03});
  for (int cycle = 0; cycle < 10000; ++cycle) {
    scene.cloth().setSaturation(saturationOfCycle(cycle));
    scene.preTick(0.01);
    scene.cloth().setSaturation(0);
    scene.preTick(0.01);
    ASSERT_TRUE(lengthsOf(scene.body()) == dry) << cycle;
  }
}

TEST_IN_EVERY_WORLD(SwellingLengths, AreGivenBackExactlyOnRemoval) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(5, 1));
  scene.step(1);
  const Lengths dry = lengthsOf(scene.body());
  Swelling& effect = scene.cloth().add<Swelling>();
  scene.cloth().setSaturation(0.37);
  scene.step(5);
  ASSERT_FALSE(lengthsOf(scene.body()) == dry);
  scene.cloth().remove(effect);
  EXPECT_TRUE(lengthsOf(scene.body()) == dry);
}

TEST_IN_EVERY_WORLD(SwellingLengths, FollowAStrainThatIsSetMidRun) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(5, 1));
  scene.step(1);
  const Lengths dry = lengthsOf(scene.body());
  Swelling& effect = scene.cloth().add<Swelling>({-0.1});
  scene.cloth().setSaturation(1);
  scene.step(2);
  adjust(effect, [](auto& p) { p.saturatedStrain = 0.05; });
  scene.step(1);
  EXPECT_NEAR(double(scene.body().m_links[3].m_rl), 1.05 * double(dry.rest[3]), kRounding);
  adjust(effect, [](auto& p) { p.saturatedStrain = 0; });
  scene.step(1);
  EXPECT_TRUE(lengthsOf(scene.body()) == dry);
}

TEST_IN_EVERY_WORLD(SwellingLengths, LeaveADryClothUntouched) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(5, 1));
  scene.step(1);
  const Lengths dry = lengthsOf(scene.body());
  scene.cloth().add<Swelling>();
  scene.step(5);
  EXPECT_TRUE(lengthsOf(scene.body()) == dry);
}

TEST_IN_EVERY_WORLD(SwellingLengths, OfABodyThatWasWetBeforeItsFirstStep) {
  ClothScene scene(GetParam(), btVector3(0, 0, 0), levelPatch(5, 1));
  scene.cloth().add<Swelling>({-0.1});
  scene.cloth().setSaturation(1);
  scene.body().m_bUpdateRtCst = true;  // as a builder of Bullet's own leaves it: the first step measures the body
  const double natural = double(scene.body().m_links[0].m_rl);
  scene.step(3);
  EXPECT_NEAR(double(scene.body().m_links[0].m_rl), 0.9 * natural, 2 * kRounding);
}

TEST_IN_EVERY_WORLD(SwellingLengths, TakeALengthOfTheApplicationAsTheNaturalOne) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(5, 1));
  scene.step(1);
  Swelling& effect = scene.cloth().add<Swelling>({-0.1});
  scene.cloth().setSaturation(1);
  scene.step(2);
  btSoftBody::Link& link = scene.body().m_links[3];
  link.m_rl = btScalar(0.75);
  scene.cloth().setSaturation(0.5);
  scene.step(1);
  EXPECT_NEAR(double(link.m_rl), 0.95 * 0.75, kRounding);
  scene.cloth().setSaturation(0);
  scene.step(1);
  EXPECT_EQ(link.m_rl, btScalar(0.75));
  scene.cloth().setSaturation(1);
  scene.step(1);
  link.m_rl = btScalar(0.5);
  scene.cloth().remove(effect);
  EXPECT_EQ(link.m_rl, btScalar(0.5)) << "set just before the effect is removed";
}

TEST_IN_EVERY_WORLD(SwellingLengths, ScaleWithBulletsRestLengthScale) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(5, 1));
  scene.step(1);
  const double natural = double(scene.body().m_links[3].m_rl);
  Swelling& effect = scene.cloth().add<Swelling>({-0.1});
  scene.cloth().setSaturation(1);
  scene.step(2);
  scene.body().setRestLengthScale(btScalar(1.5));
  scene.cloth().setSaturation(0.5);
  scene.step(1);
  EXPECT_NEAR(double(scene.body().m_links[3].m_rl), 0.95 * 1.5 * natural, 5 * kRounding);
  scene.body().setRestLengthScale(1);
  scene.cloth().remove(effect);
  EXPECT_NEAR(double(scene.body().m_links[3].m_rl), natural, 5 * kRounding);
}

// Bullet takes the shape of the wet, shrunken cloth for the one at rest: dry it is longer.
TEST_IN_EVERY_WORLD(SwellingLengths, OfACutClothAreThoseOfItsWetShape) {
  ClothScene scene(GetParam(), btVector3(0, 0, 0), levelPatch(5, 1));
  scene.wet().setLog({});
  scene.step(1);
  scene.cloth().add<Swelling>({-0.1});
  scene.cloth().setSaturation(1);
  scene.step(1);
  ASSERT_TRUE(scene.body().cutLink(scene.body().m_faces[0].m_n[0], scene.body().m_faces[0].m_n[1], btScalar(0.5)));
  std::vector<btVector3> shape;
  for (int i = 0; i < scene.body().m_nodes.size(); ++i) shape.push_back(scene.node(i).m_x);
  scene.step(2);  // in the first, Bullet measures the shape
  EXPECT_EQ(scene.cloth().effects().size(), 1u);
  scene.cloth().setSaturation(1);  // the new nodes too
  scene.step(2);
  scene.cloth().setSaturation(0);
  scene.step(2);
  for (int k = 0; k < scene.body().m_links.size(); ++k) {
    const btSoftBody::Link& link = scene.body().m_links[k];
    const std::size_t a = std::size_t(link.m_n[0] - &scene.node(0));
    const std::size_t b = std::size_t(link.m_n[1] - &scene.node(0));
    const bool isOld = a < 25 && b < 25;  // a new node's water is not known before the cut
    if (!isOld) continue;
    const double measured = double((shape[a] - shape[b]).length());
    EXPECT_NEAR(double(link.m_rl), measured / 0.9, 5 * kRounding) << k;
  }
}

TEST_IN_EVERY_WORLD(SwellingLengths, CostNothingOnceTheWaterRests) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(5, 1));
  Swelling& effect = scene.cloth().add<Swelling>({-0.01});
  wetcloth::Absorption::Parameters ramp;
  ramp.law = wetcloth::Absorption::Law::ramp;
  ramp.rampDuration = 10;
  scene.cloth().add<wetcloth::Absorption>(ramp);
  scene.step(1200);
  const long long links = scene.body().m_links.size();
  EXPECT_LE(effect.linksVisited(), 503 * links) << "500 thousandths of saturation";
  EXPECT_GE(effect.linksVisited(), 100 * links);
  scene.step(1300);
  ASSERT_NEAR(scene.cloth().meanSaturation(), 1, 1e-12);
  const long long visited = effect.linksVisited();
  scene.step(100);
  EXPECT_EQ(effect.linksVisited(), visited);
}

}  // namespace
}  // namespace wetcloth_test::swelling_lengths_test
