// SPDX-License-Identifier: Zlib
// Drops that an application is told of, the momentum they take, when the effect idles, and what it refuses.

#include "bullet_wetcloth/effects/Dripping.h"

#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"
#include "tests/support/RigidBody.h"
#include "tests/support/SoftBodies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

namespace wetcloth_test::dripping_drops_test {
namespace {

using wetcloth::Drip;
using wetcloth::Dripping;
using wetcloth::Fabric;
using wetcloth::Hook;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A saturated 5 x 5 cloth that hangs from its top edge; only our part of the step runs.
struct Hung {
  explicit Hung(Dripping::Parameters parameters = {})
      : scene(WorldKind::softRigid, kEarthGravity, hangingPatch(5), Fabric::cotton(), Hook::manual) {
    parameters.onDrip = [this](const Drip& drip) { drips.push_back(drip); };
    effect = &scene.cloth().add<Dripping>(parameters);
    scene.cloth().setSaturation(1);
  }
  double reported() const {
    double sum = 0;
    for (const Drip& drip : drips) sum += drip.mass;
    return sum;
  }
  ClothScene scene;
  std::vector<Drip> drips;
  Dripping* effect = nullptr;
};

Dripping::Parameters dropsOf(double mass) {
  Dripping::Parameters parameters;
  parameters.dropMass = mass;
  return parameters;
}

// --- drops ------------------------------------------------------------------------------------------------------

TEST(DrippingDrops, MayBeTakenBySomebodyElseMidRun) {
  Hung hung(dropsOf(1e-6));
  for (int i = 0; i < 100; ++i) hung.scene.preTick(1.0 / 240);
  const std::size_t before = hung.drips.size();
  EXPECT_GT(before, 0u);
  long long taken = 0;
  adjust(*hung.effect, [&](auto& p) { p.onDrip = [&](const Drip&) { ++taken; }; });
  for (int i = 0; i < 100; ++i) hung.scene.preTick(1.0 / 240);
  EXPECT_EQ(hung.drips.size(), before);
  EXPECT_GT(taken, 0);
  EXPECT_EQ(hung.effect->drops(), static_cast<long long>(before) + taken);
  adjust(*hung.effect, [](auto& p) { p.onDrip = {}; });
  const long long drops = hung.effect->drops();
  for (int i = 0; i < 100; ++i) hung.scene.preTick(1.0 / 240);
  EXPECT_GT(hung.effect->drops(), drops);  // it drips on, told to nobody
}

TEST(DrippingDrops, AddUpWithWhatIsPendingToWhatDripped) {
  for (const double dropMass : {0.0, 1e-6, 5e-5, 1e-3, 1.0}) {
    Hung hung(dropsOf(dropMass));
    for (int i = 0; i < 1000; ++i) {
      hung.scene.preTick(1.0 / 240);
      const double dripped = hung.scene.cloth().ledger().dripped;
      ASSERT_NEAR(hung.reported() + hung.effect->pendingMass(), dripped, 1e-14 * dripped) << dropMass;
    }
    EXPECT_EQ(hung.effect->drops(), static_cast<long long>(hung.drips.size()));
    EXPECT_EQ(hung.drips.empty(), dropMass == 1.0);
    EXPECT_LE(hung.effect->pendingMass(), 5 * dropMass) << "less than a drop at each node";
  }
}

// A hem node of an inner column drips off 0.4 C in all; each drop is full, and over by no more than one step's water.
TEST(DrippingDrops, AreFullAndAsManyAsTheWaterMakes) {
  const double dropMass = 2e-5;
  Hung hung(dropsOf(dropMass));
  const double shed = 0.4 * hung.scene.cloth().capacity(2);
  const double inOneStep = shed / 240 / 3;
  for (int i = 0; i < 240 * 60; ++i) hung.scene.preTick(1.0 / 240);  // 20 time constants
  int fromNode = 0;
  for (const Drip& drip : hung.drips) {
    EXPECT_GE(drip.mass, dropMass);
    EXPECT_LT(drip.mass, dropMass + inOneStep);
    fromNode += drip.node == 2 ? 1 : 0;
  }
  EXPECT_GE(fromNode, int(shed / (dropMass + inOneStep)));
  EXPECT_LE(fromNode, int(shed / dropMass));
  EXPECT_GT(fromNode, 10) << "or the test says nothing";
}

TEST(DrippingDrops, FallFastAndThenSlow) {
  Hung hung(dropsOf(1e-5));
  for (int i = 0; i < 240 * 12; ++i) hung.scene.preTick(1.0 / 240);
  int perTimeConstant[4] = {0, 0, 0, 0};
  for (const Drip& drip : hung.drips) ++perTimeConstant[std::min(3, int(drip.time / 3))];
  for (int k = 0; k < 3; ++k) EXPECT_GT(perTimeConstant[k], 2 * perTimeConstant[k + 1]) << k;  // by e in the law
}

TEST(DrippingDrops, OfNoMassAreOneForANodeAndStep) {
  Hung hung(dropsOf(0));
  for (int i = 0; i < 7; ++i) hung.scene.preTick(1.0 / 240);
  EXPECT_EQ(hung.drips.size(), 7u * 5);
  EXPECT_EQ(hung.effect->pendingMass(), 0);
}

TEST(DrippingDrops, SayWhenWhereHowFastAndWhence) {
  Hung hung(dropsOf(0));
  const btVector3 velocity(btScalar(0.25), -2, 1);
  setVelocity(hung.scene.body(), velocity);
  hung.scene.preTick(0.25);
  hung.scene.preTick(0.25);
  ASSERT_EQ(hung.drips.size(), 10u);
  for (std::size_t k = 0; k < 10; ++k) {
    const Drip& drip = hung.drips[k];
    EXPECT_EQ(drip.time, k < 5 ? 0 : 0.25);
    EXPECT_EQ(drip.node, int(k % 5));
    EXPECT_EQ(drip.position, hung.scene.node(drip.node).m_x);
    EXPECT_EQ(drip.velocity, velocity);
    EXPECT_EQ(drip.cloth, &hung.scene.cloth());
  }
}

TEST(DrippingDrops, AreCountedWhenNobodyListens) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, hangingPatch(5), Fabric::cotton(), Hook::manual);
  Dripping& effect = scene.cloth().add<Dripping>(dropsOf(0));
  scene.cloth().setSaturation(1);
  scene.preTick(1);
  EXPECT_EQ(effect.drops(), 5);
}

TEST(DrippingDrops, AListenerThatThrowsTakesTheEffectAway) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, hangingPatch(5));
  std::vector<std::string> messages;
  scene.wet().setLog([&](const std::string& message) { messages.push_back(message); });
  Dripping::Parameters parameters = dropsOf(0);
  parameters.onDrip = [](const Drip&) { throw std::runtime_error("no bucket"); };
  scene.cloth().add<Dripping>(parameters);
  scene.cloth().setSaturation(1);
  EXPECT_NO_THROW(scene.step(3));
  EXPECT_TRUE(scene.cloth().effects().empty());
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("Dripping"), std::string::npos);
  EXPECT_NE(messages[0].find("no bucket"), std::string::npos);
  EXPECT_LE(std::fabs(scene.cloth().ledger().imbalance()), 1e-15);
}

// --- momentum ---------------------------------------------------------------------------------------------------

TEST(DrippingMomentum, GoesWithTheDropsAndTheClothKeepsItsVelocity) {
  Hung hung(dropsOf(0));
  for (int i = 0; i < 20; ++i) hung.scene.node(i).m_v = btVector3(btScalar(0.5 * i), btScalar(3 - i), 1);
  const auto before = momentum(hung.scene.body());
  for (int i = 0; i < 30; ++i) hung.scene.preTick(0.1);
  auto after = momentum(hung.scene.body());
  for (const Drip& drip : hung.drips) {
    for (int k = 0; k < 3; ++k) after[std::size_t(k)] += drip.mass * double(drip.velocity[k]);
  }
  ASSERT_GT(hung.reported(), 0.001);
  // float32 rounds each node's mass once a step: 6e-8 of 0.3 kg x 17 m/s.
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(after[k], before[k], kIsDouble ? 1e-14 : 2e-6) << k;
  for (int i = 0; i < 20; ++i) EXPECT_EQ(hung.scene.node(i).m_v, btVector3(btScalar(0.5 * i), btScalar(3 - i), 1));
}

// --- a cloth that does not drip costs nothing -------------------------------------------------------------------

TEST(DrippingIdles, WhenNothingIsAboveTheHoldingCapacity) {
  Hung hung;
  hung.scene.cloth().setSaturation(0.5);
  hung.scene.preTick(1);
  const long long visited = hung.effect->nodesVisited();
  for (int i = 0; i < 100; ++i) {
    hung.scene.node(0).m_x += btVector3(0, btScalar(0.1), 0);  // whatever its shape
    hung.scene.preTick(1);
  }
  EXPECT_EQ(hung.effect->nodesVisited(), visited);
  hung.scene.cloth().setSaturation(0.7);
  hung.scene.preTick(1);
  EXPECT_GT(hung.effect->nodesVisited(), visited);
  EXPECT_GT(hung.effect->drippedMass(), 0);
}

TEST(DrippingIdles, WhenTheHemHasDrippedOff) {
  Hung hung;
  for (int i = 0; i < 200; ++i) hung.scene.preTick(1);
  const long long visited = hung.effect->nodesVisited();
  const long long commits = hung.scene.cloth().masses().commits();
  for (int i = 0; i < 100; ++i) hung.scene.preTick(1);
  EXPECT_EQ(hung.effect->nodesVisited(), visited);
  EXPECT_EQ(hung.scene.cloth().masses().commits(), commits);
  EXPECT_EQ(hung.scene.cloth().saturation(20), 1) << "water above the hem is still there";
}

TEST(DrippingIdles, UntilTheClothIsTurned) {
  Hung hung;
  for (int i = 0; i < 200; ++i) hung.scene.preTick(1);
  const double before = hung.effect->drippedMass();
  for (int i = 0; i < 25; ++i) hung.scene.node(i).m_x.setY(-hung.scene.node(i).m_x.y());
  for (int i = 0; i < 32; ++i) hung.scene.preTick(1);  // SteadyState looks at each node once in 32 steps
  EXPECT_GT(hung.effect->drippedMass(), before);
  EXPECT_LT(hung.scene.cloth().saturation(20), 1);
}

TEST(DrippingIdles, UntilItsHoldingCapacityChanges) {
  Hung hung;
  for (int i = 0; i < 200; ++i) hung.scene.preTick(1);
  adjust(*hung.effect, [](auto& p) { p.holdingSaturation = 0.2; });
  hung.scene.preTick(3);
  EXPECT_NEAR(hung.scene.cloth().saturation(2), 0.2 + 0.4 * std::exp(-1), 1e-12);
  EXPECT_NE(rejection([&] { adjust(*hung.effect, [](auto& p) { p.holdingSaturation = 1.25; }); }).find("1.25"),
            std::string::npos);
  EXPECT_EQ(hung.effect->parameters().holdingSaturation, 0.2);
}

// --- in Bullet's worlds -----------------------------------------------------------------------------------------

TEST_IN_EVERY_WORLD(DrippingDropsInWorld, MayBecomeRigidBodies) {
  ClothScene scene(GetParam(), kEarthGravity, hangingPatch(3));
  scene.addBulletSpringsForStep();
  std::vector<std::unique_ptr<RigidBody>> drops;
  Dripping::Parameters parameters = dropsOf(1e-3);
  parameters.onDrip = [&](const Drip& drip) {
    const btVector3 below = drip.position - btVector3(0, 1, 0);  // clear of the cloth
    drops.push_back(std::make_unique<RigidBody>(scene.bullet(), std::make_unique<btSphereShape>(btScalar(0.01)),
                                                btScalar(drip.mass), below));
    drops.back()->body().setLinearVelocity(drip.velocity);
  };
  scene.cloth().add<Dripping>(parameters);
  scene.cloth().setSaturation(1);
  scene.step(480);
  ASSERT_GT(drops.size(), 3u);
  EXPECT_LT(drops.front()->body().getWorldTransform().getOrigin().y(), -2) << "it falls";
  EXPECT_TRUE(isFinite(scene.body()));
}

TEST_IN_EVERY_WORLD(DrippingDropsInWorld, AreNotLostWhenTheClothIsCut) {
  ClothScene scene(GetParam(), kEarthGravity, hangingPatch(5));
  scene.addBulletSpringsForStep();
  scene.wet().setLog({});
  double reported = 0;
  Dripping::Parameters parameters;
  parameters.onDrip = [&](const Drip& drip) { reported += drip.mass; };
  Dripping& effect = scene.cloth().add<Dripping>(parameters);
  scene.cloth().setSaturation(1);
  scene.step(60);
  btSoftBody& body = scene.body();
  ASSERT_TRUE(body.cutLink(body.m_faces[0].m_n[0], body.m_faces[0].m_n[1], btScalar(0.5)));
  scene.step(60);
  ASSERT_EQ(scene.cloth().effects().size(), 1u);
  const wetcloth::Ledger ledger = scene.cloth().ledger();
  EXPECT_GT(effect.pendingMass(), 0);
  EXPECT_NEAR(reported + effect.pendingMass(), ledger.dripped, 1e-14);
  EXPECT_LE(std::fabs(ledger.imbalance()), 1e-12 * ledger.initial);
}

// --- bad input --------------------------------------------------------------------------------------------------

void expectRefused(double Dripping::Parameters::*field, const std::string& name, const std::vector<double>& values) {
  for (const double bad : values) {
    Dripping::Parameters parameters;
    parameters.*field = bad;
    const std::string message = rejection([&] { Dripping{parameters}; });
    EXPECT_EQ(message.find("Dripping." + name + " = "), 0u) << bad << ": " << message;
  }
}

TEST(DrippingBadInput, IsNamed) {
  expectRefused(&Dripping::Parameters::holdingSaturation, "holdingSaturation", {-0.1, 1.1, kNaN, kInfinity});
  expectRefused(&Dripping::Parameters::timeConstant, "timeConstant", {0, -1, kNaN, kInfinity});
  expectRefused(&Dripping::Parameters::dropMass, "dropMass", {-1e-5, kNaN, kInfinity});
  expectRefused(&Dripping::Parameters::slopeTolerance, "slopeTolerance", {-0.1, 1.1, kNaN, kInfinity});
  expectRefused(&Dripping::Parameters::squeeze, "squeeze", {-0.1, 1.1, kNaN, kInfinity});
}

TEST(DrippingBadInput, ABodyWithoutTrianglesIsRefused) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, hangingRope(3, 0.1, 0.1));
  const std::string message = rejection([&] { scene.cloth().add<Dripping>(); });
  EXPECT_NE(message.find("Dripping: body.m_faces.size() = 0"), std::string::npos) << message;
  EXPECT_TRUE(scene.cloth().effects().empty());
}

}  // namespace
}  // namespace wetcloth_test::dripping_drops_test
