// SPDX-License-Identifier: Zlib
// Water that is pressed out of cloth that is compressed or crumpled: how much, from where, and when not.

#include "bullet_wetcloth/effects/Dripping.h"

#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/SoftBodies.h"

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace wetcloth_test::dripping_squeeze_test {
namespace {

using wetcloth::Dripping;
using wetcloth::Fabric;
using wetcloth::Hook;
using wetcloth::squeezedRoom;

constexpr double kHolding = 0.6;
constexpr double kTimeConstant = 3;
/// Of what lengths in float32 leave of a share.
constexpr double kRounding = 1e-6;

Dripping::Parameters squeezing(double squeeze) {
  Dripping::Parameters parameters;
  parameters.holdingSaturation = kHolding;
  parameters.timeConstant = kTimeConstant;
  parameters.squeeze = squeeze;
  return parameters;
}

using Place = std::function<btVector3(const btVector3&)>;

btVector3 halved(const btVector3& x) { return {x.x() / 2, x.y(), x.z()}; }
btVector3 asItIs(const btVector3& x) { return x; }

/// Saturated cloth of 5 x 5 nodes that is put in another shape; only our part of the step runs.
struct Shaped {
  Shaped(const wetcloth::ClothPatch& patch, double squeeze, const Place& place = asItIs)
      : scene(WorldKind::softRigid, kEarthGravity, patch, Fabric::cotton(), Hook::manual),
        effect(scene.cloth().add<Dripping>(squeezing(squeeze))) {
    scene.cloth().setSaturation(1);
    put(place);
  }
  void put(const Place& place) {
    for (int i = 0; i < scene.body().m_nodes.size(); ++i) scene.node(i).m_x = place(scene.node(i).m_x);
  }
  void run(int steps, double dt) {
    for (int i = 0; i < steps; ++i) scene.preTick(dt);
  }
  std::vector<double> saturations() {
    std::vector<double> all;
    for (int i = 0; i < scene.cloth().nodeCount(); ++i) all.push_back(scene.cloth().saturation(i));
    return all;
  }
  ClothScene scene;
  Dripping& effect;
};

double closedForm(double holding, double time) { return holding + (1 - holding) * std::exp(-time / kTimeConstant); }

TEST(SqueezedRoom, GoesWithTheAreaAsMuchAsTheSqueeze) {
  EXPECT_EQ(squeezedRoom(0.3, 0), 1);
  EXPECT_EQ(squeezedRoom(1, 1), 1);
  EXPECT_EQ(squeezedRoom(0, 1), 0);
  EXPECT_DOUBLE_EQ(squeezedRoom(0.5, 1), 0.5);
  EXPECT_DOUBLE_EQ(squeezedRoom(0.5, 0.5), 0.75);
}

// --- how much ----------------------------------------------------------------------------------------------------

TEST(DrippingSqueeze, ALevelClothOfHalfItsAreaHoldsHalfAsMuch) {
  for (const auto& [dt, steps] : {std::pair{2.0, 1}, {1.0 / 16, 32}, {1.0 / 4096, 8192}}) {
    Shaped cloth(levelPatch(5, 1), 1, halved);
    cloth.run(steps, dt);
    for (const double saturation : cloth.saturations()) {
      EXPECT_NEAR(saturation, closedForm(kHolding / 2, 2), kRounding) << dt;
    }
  }
}

TEST(DrippingSqueeze, EndsAtHalfAsMuchAndNotBelow) {
  Shaped cloth(levelPatch(5, 1), 1, halved);
  cloth.run(3, 1e3);
  for (const double saturation : cloth.saturations()) EXPECT_NEAR(saturation, kHolding / 2, kRounding);
}

TEST(DrippingSqueeze, HalfTheSqueezeTakesHalfTheRoom) {
  Shaped cloth(levelPatch(5, 1), 0.5, halved);
  cloth.run(3, 1e3);
  for (const double saturation : cloth.saturations()) EXPECT_NEAR(saturation, 0.75 * kHolding, kRounding);
}

TEST(DrippingSqueeze, PressesOutWhereNothingDrips) {
  Shaped hung(hangingPatch(5), 1, halved);
  hung.run(32, 1.0 / 16);
  for (int i = 0; i < 25; ++i) {
    const double holding = i < 5 ? kHolding / 2 : 0.5;  // the hem is low
    EXPECT_NEAR(hung.scene.cloth().saturation(i), closedForm(holding, 2), kRounding) << i;
  }
}

TEST(DrippingSqueeze, PressesOutAlongACrease) {
  // The upper half is turned down to the front, by a right angle; the crease is level.
  const auto crease = [](const btVector3& x) {
    return x.y() > btScalar(0.5) ? btVector3(x.x(), btScalar(0.5), x.y() - btScalar(0.5)) : x;
  };
  Shaped cloth(hangingPatch(5), 1, crease);
  cloth.run(3, 1e3);
  // In the middle of the row, where as much of a node's triangles is on either side of the crease.
  for (int i = 11; i < 14; ++i) EXPECT_NEAR(cloth.scene.cloth().saturation(i), std::sqrt(0.5), kRounding) << i;
  for (int i = 5; i < 10; ++i) EXPECT_EQ(cloth.scene.cloth().saturation(i), 1) << i;
}

// --- when not ------------------------------------------------------------------------------------------------------

TEST(DrippingSqueeze, ChangesNoBitWhereClothIsStretchedOrAsAtRest) {
  const auto wide = [](const btVector3& x) { return btVector3(3 * x.x(), x.y(), x.z()); };
  for (const Place& place : {Place(asItIs), Place(wide)}) {
    Shaped with(hangingPatch(5), 1, place);
    Shaped without(hangingPatch(5), 0, place);
    with.run(100, 1.0 / 64);
    without.run(100, 1.0 / 64);
    EXPECT_EQ(with.saturations(), without.saturations());
    EXPECT_LT(with.scene.cloth().saturation(0), 1);
  }
}

TEST(DrippingSqueeze, IsOffByDefault) {
  EXPECT_EQ(Dripping::Parameters().squeeze, 0);
  Shaped cloth(hangingPatch(5), 0, halved);
  cloth.run(3, 1e3);
  for (int i = 5; i < 25; ++i) EXPECT_EQ(cloth.scene.cloth().saturation(i), 1) << i;
  EXPECT_DOUBLE_EQ(cloth.scene.cloth().saturation(0), kHolding);
}

TEST(DrippingSqueeze, StaysInTheClothWithoutGravity) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(5, 1), Fabric::cotton(), Hook::manual);
  scene.cloth().add<Dripping>(squeezing(1));
  scene.cloth().setSaturation(1);
  for (int i = 0; i < 25; ++i) scene.node(i).m_x = halved(scene.node(i).m_x);
  scene.preTick(1);
  EXPECT_EQ(scene.cloth().ledger().dripped, 0);
}

TEST(DrippingSqueeze, GoesOnWhenAClothThatRestedIsPressed) {
  Shaped cloth(hangingPatch(5), 1);
  cloth.scene.cloth().setSaturation(0.55);
  cloth.run(200, 1.0 / 64);
  const long long visited = cloth.effect.nodesVisited();
  cloth.run(200, 1.0 / 64);
  EXPECT_EQ(cloth.effect.nodesVisited(), visited) << "nothing to do, and nothing moves";
  EXPECT_EQ(cloth.scene.cloth().ledger().dripped, 0);
  cloth.put(halved);
  cloth.run(40, 1);
  for (int i = 5; i < 25; ++i) EXPECT_NEAR(cloth.scene.cloth().saturation(i), 0.5, 1e-5) << i;
}

TEST(DrippingSqueeze, AClothDrierThanAnySqueezeIdlesAtOnce) {
  Shaped cloth(hangingPatch(5), 0.5);
  cloth.scene.cloth().setSaturation(0.29);
  cloth.run(1, 1);
  const long long visited = cloth.effect.nodesVisited();
  cloth.put(halved);
  cloth.run(10, 1);
  EXPECT_EQ(cloth.effect.nodesVisited(), visited);
}

// --- bookkeeping -------------------------------------------------------------------------------------------------

TEST(DrippingSqueeze, TheLedgerClosesWhileTheClothIsPressed) {
  for (const double dt : {1e-6, 1.0 / 240, 1e3}) {
    Shaped cloth(hangingPatch(5), 1);
    for (int i = 0; i < 2000; ++i) {
      cloth.put([](const btVector3& x) { return btVector3(x.x() * btScalar(0.999), x.y(), x.z()); });
      cloth.scene.preTick(dt);
    }
    const wetcloth::Ledger ledger = cloth.scene.cloth().ledger();
    EXPECT_GT(ledger.dripped, 0);
    EXPECT_LE(std::fabs(ledger.imbalance()), 1e-12 * ledger.initial) << dt;
    EXPECT_NEAR(cloth.effect.drippedMass(), ledger.dripped, 1e-15 * ledger.initial) << dt;
    for (const double saturation : cloth.saturations()) EXPECT_GE(saturation, 0) << dt;
  }
}

TEST(DrippingSqueeze, ANodeThatIsNotFiniteIsNotPressed) {
  Shaped cloth(hangingPatch(5), 1, halved);
  const btScalar notANumber = std::numeric_limits<btScalar>::quiet_NaN();
  cloth.scene.node(12).m_x = btVector3(notANumber, notANumber, notANumber);
  cloth.run(10, 1);
  for (const double saturation : cloth.saturations()) EXPECT_TRUE(std::isfinite(saturation));
  EXPECT_GE(cloth.scene.cloth().saturation(12), kHolding);
}

// --- in Bullet's worlds ------------------------------------------------------------------------------------------

TEST_IN_EVERY_WORLD(DrippingSqueezeInWorld, ClothThatPinsPressTogetherLosesWaterByTheClosedForm) {
  wetcloth::ClothPatch patch = hangingPatch(2);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top, wetcloth::ClothPatch::Edge::bottom};
  ClothScene scene(GetParam(), kEarthGravity, patch);
  scene.addBulletSpringsForStep();
  scene.cloth().add<Dripping>(squeezing(1));
  scene.cloth().setSaturation(1);
  for (int i = 0; i < 4; ++i) scene.node(i).m_x = halved(scene.node(i).m_x);
  scene.step(512, kExactSubstep);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(scene.cloth().saturation(i), closedForm(i < 2 ? kHolding / 2 : 0.5, 2), kRounding) << i;
  }
}

TEST_IN_EVERY_WORLD(DrippingSqueezeInWorld, ClothThatIsCutIsPressedOn) {
  ClothScene scene(GetParam(), kEarthGravity, hangingPatch(5));
  scene.addBulletSpringsForStep();
  scene.wet().setLog({});
  scene.cloth().add<Dripping>(squeezing(1));
  scene.cloth().setSaturation(1);
  scene.step(1);
  btSoftBody& body = scene.body();
  ASSERT_TRUE(body.cutLink(body.m_faces[0].m_n[0], body.m_faces[0].m_n[1], btScalar(0.5)));
  const int newNode = body.m_nodes.size() - 1;
  for (int i = 0; i <= newNode; ++i) scene.node(i).m_x *= btScalar(0.5);
  scene.step(1);
  ASSERT_EQ(scene.cloth().effects().size(), 1u);
  for (const int node : {12, newNode}) EXPECT_LT(scene.cloth().saturation(node), 0.9999) << node;
  const wetcloth::Ledger ledger = scene.cloth().ledger();
  EXPECT_LE(std::fabs(ledger.imbalance()), 1e-12 * ledger.initial);
}

}  // namespace
}  // namespace wetcloth_test::dripping_squeeze_test
