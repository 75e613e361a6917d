// SPDX-License-Identifier: Zlib
// How much drips, and from where: the closed form at a lone low point, hems, level and tilted cloths.

#include "bullet_wetcloth/effects/Dripping.h"

#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/SoftBodies.h"

#include <cmath>
#include <limits>
#include <vector>

namespace wetcloth_test::dripping_law_test {
namespace {

using wetcloth::Dripping;
using wetcloth::drippingStep;
using wetcloth::Fabric;
using wetcloth::Hook;
using wetcloth::isLower;

// --- free functions -------------------------------------------------------------------------------------------

TEST(DrippingStep, IsTheExponentialOfWhatIsAboveTheHoldingCapacity) {
  EXPECT_NEAR(drippingStep(3, 1, 4, 4), 2 * (1 - std::exp(-1.0)), 1e-15);
  EXPECT_EQ(drippingStep(1, 1, 4, 4), 0);
  EXPECT_EQ(drippingStep(0.5, 1, 4, 4), 0);
  EXPECT_EQ(drippingStep(0, 0, 4, 4), 0);
}

TEST(DrippingStep, KeepsItsDigitsWhenShortAndTakesAllWhenLong) {
  EXPECT_NEAR(drippingStep(3, 1, 1, 1e-18) / 2e-18, 1, 1e-15);
  EXPECT_EQ(drippingStep(3, 1, 1, 1e3), 2);
}

TEST(DrippingStep, TwoStepsMakeOneOfTwiceTheTime) {
  for (const double dt : {1e-9, 1e-3, 0.3, 2.0, 20.0}) {
    const double first = drippingStep(1, 0.25, 3, dt);
    EXPECT_NEAR(first + drippingStep(1 - first, 0.25, 3, dt), drippingStep(1, 0.25, 3, 2 * dt), 1e-15) << dt;
  }
}

TEST(DrippingLowPoint, ANeighbourIsLowerWhenTheSlopeIsAboveTheTolerance) {
  const btVector3 down(0, -1, 0);
  const btVector3 x(1, 2, 3);
  const auto below = [&](double slope) {
    return x + btVector3(btScalar(std::sqrt(1 - slope * slope)), btScalar(-slope), 0) * btScalar(0.25);
  };
  EXPECT_TRUE(isLower(below(0.03), x, down, 0.02));
  EXPECT_FALSE(isLower(below(0.01), x, down, 0.02));
  EXPECT_FALSE(isLower(below(-0.5), x, down, 0.02));
  EXPECT_TRUE(isLower(below(-0.5), x, -down, 0.02));
  EXPECT_FALSE(isLower(x, x, down, 0.02));
  EXPECT_FALSE(isLower(below(1), x, down, 1)) << "no slope is above 1";
  EXPECT_FALSE(isLower(btVector3(0, std::numeric_limits<btScalar>::quiet_NaN(), 0), x, down, 0.02));
}

// --- a lone low point -----------------------------------------------------------------------------------------

/// One triangle that stands on its node 2; only our part of the step runs.
struct Funnel {
  explicit Funnel(Dripping::Parameters parameters = {}, bool pinned = false)
      : scene(WorldKind::softRigid, kEarthGravity,
              triangles({btVector3(0, 1, 0), btVector3(1, 1, 0), btVector3(btScalar(0.5), 0, 0)},
                        {1, 1, btScalar(pinned ? 0 : 1)}, {{0, 1, 2}}),
              Fabric::cotton(), Hook::manual),
        effect(scene.cloth().add<Dripping>(std::move(parameters))) {
    scene.cloth().setSaturation(1);
  }
  double saturation(int node) { return scene.cloth().saturation(node); }
  ClothScene scene;
  Dripping& effect;
};

/// s(t) = h + (1 - h) exp(-t / tau), the default's h and tau.
double closedForm(double time) { return 0.6 + 0.4 * std::exp(-time / 3); }

TEST(DrippingLaw, ALoneLowPointFollowsTheClosedFormWhateverTheStep) {
  // Steps that float32 holds exactly. 1e-12: a million roundings of the last digit, which the carry keeps from adding
  // up.
  const struct {
    double dt;
    int count;
  } splits[] = {{2, 1}, {1, 2}, {1.0 / 16, 32}, {1.0 / 4096, 8192}, {1.0 / (1 << 19), 1 << 20}};
  for (const auto& split : splits) {
    Funnel funnel;
    for (int i = 0; i < split.count; ++i) funnel.scene.preTick(split.dt);
    EXPECT_NEAR(funnel.saturation(2) / closedForm(2), 1, 1e-12) << split.dt;
    EXPECT_EQ(funnel.saturation(0), 1) << "only the low point drips";
    EXPECT_EQ(funnel.saturation(1), 1);
  }
}

TEST(DrippingLaw, APinnedLowPointDripsToo) {
  Funnel funnel({}, true);
  ASSERT_EQ(funnel.scene.node(2).m_im, 0);
  for (int i = 0; i < 32; ++i) funnel.scene.preTick(1.0 / 16);
  EXPECT_NEAR(funnel.saturation(2) / closedForm(2), 1, 1e-12);
  EXPECT_EQ(funnel.scene.node(2).m_im, 0);
}

TEST(DrippingLaw, ALongStepEndsAtTheHoldingCapacityAndNotBelow) {
  for (const double holding : {0.0, 0.25, 0.6, 1.0}) {
    Dripping::Parameters parameters;
    parameters.holdingSaturation = holding;
    Funnel funnel(parameters);
    for (int i = 0; i < 3; ++i) funnel.scene.preTick(1e3);
    EXPECT_DOUBLE_EQ(funnel.saturation(2), holding);
    EXPECT_GE(funnel.scene.cloth().held(2), 0);
  }
}

TEST(DrippingLaw, ShortStepsEndAtTheHoldingCapacity) {
  Funnel funnel;
  for (int i = 0; i < 4000; ++i) funnel.scene.preTick(1.0 / 32);  // 41 time constants, exp(-41) = 1e-18
  EXPECT_DOUBLE_EQ(funnel.saturation(2), 0.6);
}

TEST(DrippingLaw, AnOverfullNodeDripsByTheSameLaw) {
  Funnel funnel;
  std::vector<double> held(3, 0.0);
  held[2] = 3 * funnel.scene.cloth().capacity(2);
  funnel.scene.cloth().setHeld(held);
  funnel.scene.preTick(1.5);
  EXPECT_NEAR(funnel.saturation(2), 0.6 + 2.4 * std::exp(-0.5), 1e-14);
}

TEST(DrippingLaw, NothingDripsAtOrBelowTheHoldingCapacity) {
  for (const double saturation : {0.0, 0.3, 0.6}) {
    Funnel funnel;
    funnel.scene.cloth().setSaturation(saturation);
    for (int i = 0; i < 10; ++i) funnel.scene.preTick(1);
    EXPECT_EQ(funnel.scene.cloth().ledger().dripped, 0) << saturation;
  }
}

TEST(DrippingLaw, TheLedgerClosesOverSteps) {
  for (const double dt : {1e-6, 1e-3, 1.0 / 240, 1.0, 1e3}) {
    Funnel funnel;
    for (int i = 0; i < 10000; ++i) funnel.scene.preTick(dt);
    const wetcloth::Ledger ledger = funnel.scene.cloth().ledger();
    EXPECT_GT(ledger.dripped, 0);
    EXPECT_LE(std::fabs(ledger.imbalance()), 1e-12 * ledger.initial) << dt;
    EXPECT_NEAR(funnel.effect.drippedMass(), ledger.dripped, 1e-15 * ledger.initial) << dt;
    EXPECT_GE(funnel.saturation(2), 0.6 * (1 - 1e-15)) << dt;
  }
}

// However short the step: a process of minutes must not be taken for one that is over.
TEST(DrippingLaw, SlowDrippingNeverStalls) {
  Dripping::Parameters parameters;
  parameters.timeConstant = 1000;
  Funnel funnel(parameters);
  const double dt = 1.0 / (1 << 20);
  for (int i = 0; i < 1000; ++i) funnel.scene.preTick(dt);
  const double expected = 0.4 * funnel.scene.cloth().capacity(2) * -std::expm1(-1000 * dt / 1000);
  // The last digit of the water held, a thousandth of which has not been shown yet.
  EXPECT_NEAR(funnel.scene.cloth().ledger().dripped, expected, 3e-16);
}

// --- where it drips ---------------------------------------------------------------------------------------------

/// Which nodes of a saturated body have lost water after a step.
std::vector<int> dripping(ClothScene& scene, Dripping::Parameters parameters = {}) {
  scene.cloth().add<Dripping>(std::move(parameters));
  scene.cloth().setSaturation(1);
  scene.preTick(1);
  std::vector<int> nodes;
  for (int i = 0; i < scene.cloth().nodeCount(); ++i) {
    if (scene.cloth().saturation(i) < 1) nodes.push_back(i);
  }
  return nodes;
}

BodyBuilder built(const wetcloth::ClothPatch& patch, const std::function<void(btSoftBody&)>& prepare) {
  return [=](btSoftBodyWorldInfo& info) {
    std::unique_ptr<btSoftBody> body = patch.build(info);
    prepare(*body);
    return body;
  };
}

const std::vector<int> kBottomRow = {0, 1, 2, 3, 4};

TEST(DrippingLowPoint, AllNodesOfALevelHemDrip) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, hangingPatch(5), Fabric::cotton(), Hook::manual);
  EXPECT_EQ(dripping(scene), kBottomRow);
}

TEST(DrippingLowPoint, RoundingDoesNotDecide) {
  const auto shake = [](btSoftBody& body) {
    for (int i = 0; i < 5; ++i) body.m_nodes[i].m_x.setY(btScalar(i % 2 == 0 ? 1e-6 : -1e-6));
  };
  ClothScene scene(WorldKind::softRigid, kEarthGravity, built(hangingPatch(5), shake), Fabric::cotton(), Hook::manual);
  EXPECT_EQ(dripping(scene), kBottomRow);
}

TEST(DrippingLowPoint, ASlantingHemDripsAtItsLowestNode) {
  const auto slant = [](btSoftBody& body) {
    for (int i = 0; i < 5; ++i) body.m_nodes[i].m_x.setY(btScalar(0.02 * i));  // a slope of 0.08
  };
  ClothScene scene(WorldKind::softRigid, kEarthGravity, built(hangingPatch(5), slant), Fabric::cotton(), Hook::manual);
  EXPECT_EQ(dripping(scene), std::vector<int>{0});
}

TEST(DrippingLowPoint, ASaggingClothDripsAtItsPocket) {
  const auto sag = [](btSoftBody& body) {
    for (int i = 0; i < 25; ++i) body.m_nodes[i].m_x.setY(body.m_nodes[i].m_x.length2());
  };
  ClothScene scene(WorldKind::softRigid, kEarthGravity, built(levelPatch(5, 1), sag), Fabric::cotton(), Hook::manual);
  EXPECT_EQ(dripping(scene), std::vector<int>{12});
}

TEST(DrippingLowPoint, GravityMayPointAnywhere) {
  const btVector3 sideways(5, 0, 0);
  ClothScene scene(WorldKind::softRigid, sideways, hangingPatch(3), Fabric::cotton(), Hook::manual);
  EXPECT_EQ(dripping(scene), (std::vector<int>{2, 5, 8}));
}

TEST(DrippingLowPoint, ALevelClothDripsEverywhere) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, levelPatch(4, 1), Fabric::cotton(), Hook::manual);
  EXPECT_EQ(dripping(scene).size(), 16u);
}

TEST(DrippingLowPoint, ALargerToleranceMakesMoreLowPoints) {
  Dripping::Parameters parameters;
  parameters.slopeTolerance = 1;
  ClothScene scene(WorldKind::softRigid, kEarthGravity, hangingPatch(4), Fabric::cotton(), Hook::manual);
  EXPECT_EQ(dripping(scene, parameters).size(), 16u);
}

TEST(DrippingLowPoint, WithoutGravityNothingDrips) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), hangingPatch(4), Fabric::cotton(), Hook::manual);
  EXPECT_TRUE(dripping(scene).empty());
}

// --- in Bullet's worlds -----------------------------------------------------------------------------------------

TEST_IN_EVERY_WORLD(DrippingInWorld, TheHemOfAHungClothFollowsTheClosedForm) {
  // The hem on a rail: where springs let it swing for a while after the start it is no low point all the time.
  wetcloth::ClothPatch patch = hangingPatch(5);
  patch.pinnedEdges.push_back(wetcloth::ClothPatch::Edge::bottom);
  ClothScene scene(GetParam(), kEarthGravity, patch);
  scene.addBulletSpringsForStep();
  scene.cloth().add<Dripping>();
  scene.cloth().setSaturation(1);
  scene.step(512, kExactSubstep);
  for (int i = 0; i < 25; ++i) {
    EXPECT_NEAR(scene.cloth().saturation(i), i < 5 ? closedForm(2) : 1, 1e-12) << i;
  }
}

}  // namespace
}  // namespace wetcloth_test::dripping_law_test
