// SPDX-License-Identifier: Zlib
// Water that lands brings its own velocity: v' = (m v + dm u) / (m + dm), so momentum is neither made nor lost.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"

namespace wetcloth_test::water_momentum_test {

namespace {

using Vector = std::array<double, 3>;

// Some thirty velocities, each rounded to Bullet's scalar.
constexpr double kTolerance = kIsDouble ? 1e-12 : 1e-5;

Vector momentumOfFreeNodes(const wetcloth::WetCloth& cloth) {
  Vector sum = {0, 0, 0};
  for (int i = 0; i < cloth.nodeCount(); ++i) {
    const btSoftBody::Node& node = cloth.body().m_nodes[i];
    if (node.m_im == 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      sum[std::size_t(axis)] += (cloth.dryMass(i) + cloth.held(i)) * double(node.m_v[axis]);
    }
  }
  return sum;
}

double waterOfFreeNodes(const wetcloth::WetCloth& cloth) {
  double sum = 0;
  for (int i = 0; i < cloth.nodeCount(); ++i) {
    if (cloth.body().m_nodes[i].m_im != 0) sum += cloth.held(i);
  }
  return sum;
}

void scatterVelocities(btSoftBody& body) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    if (body.m_nodes[i].m_im == 0) continue;
    body.m_nodes[i].m_v = btVector3(btScalar(0.3 * (i % 5)), btScalar(-1 + 0.2 * (i % 7)), btScalar(0.1 * i));
    body.m_nodes[i].m_vn = body.m_nodes[i].m_v;
  }
}

wetcloth::Absorption::Parameters rain(const wetcloth::WetCloth& cloth, const btVector3& velocity) {
  std::vector<double> exposure;
  for (int i = 0; i < cloth.nodeCount(); ++i) exposure.push_back(double(i % 4) / 3);
  wetcloth::Absorption::Parameters parameters;
  parameters.exposure = exposure;
  parameters.waterVelocity = velocity;
  return parameters;
}

// Only our own part of the step, so that nothing else changes velocities.
TEST_IN_EVERY_WORLD(WaterMomentum, IsConservedWhenWaterLands) {
  wetcloth::ClothPatch patch = squarePatch(5);
  patch.pinnedNodes = {0, 6, 13};
  const btVector3 waterVelocity(2, -9, btScalar(0.5));
  BodyScene scene(GetParam(), patch);
  wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(3, 0.5)));
  cloth.add<wetcloth::Absorption>(rain(cloth, waterVelocity));
  scatterVelocities(scene.body());
  const Vector before = momentumOfFreeNodes(cloth);
  for (int step = 0; step < 50; ++step) wet.preTick(btScalar(0.01));
  const double water = waterOfFreeNodes(cloth);
  ASSERT_GT(water, 0.5 * (cloth.totalMass() - water)) << "much water has landed";
  const Vector after = momentumOfFreeNodes(cloth);
  const double scale = water * double(waterVelocity.length());
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = std::size_t(axis);
    EXPECT_NEAR(after[a], before[a] + water * double(waterVelocity[axis]), kTolerance * scale) << axis;
  }
}

// Each node by itself, in one step.
TEST_IN_EVERY_WORLD(WaterMomentum, GivesEachNodeTheVelocityOfAnInelasticImpact) {
  const btVector3 waterVelocity(2, -9, btScalar(0.5));
  BodyScene scene(GetParam(), squarePatch(4));
  wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(3, 0.5)));
  cloth.setSaturation(0.25);
  cloth.add<wetcloth::Absorption>(rain(cloth, waterVelocity));
  scatterVelocities(scene.body());
  std::vector<double> heldBefore;
  for (int i = 0; i < cloth.nodeCount(); ++i) heldBefore.push_back(cloth.held(i));
  const std::vector<btScalar> before = stateOf(scene.body());
  wet.preTick(btScalar(0.2));
  for (int i = 0; i < cloth.nodeCount(); ++i) {
    const double mass = cloth.dryMass(i) + heldBefore[std::size_t(i)];
    const double arrived = cloth.held(i) - heldBefore[std::size_t(i)];
    for (int axis = 0; axis < 3; ++axis) {
      const double v = double(before[std::size_t(6 * i + 2 * axis + 1)]);
      const double expected = (mass * v + arrived * double(waterVelocity[axis])) / (mass + arrived);
      EXPECT_NEAR(double(scene.body().m_nodes[i].m_v[axis]), expected, kTolerance * 10) << i;
    }
  }
}

TEST_IN_EVERY_WORLD(WaterMomentum, PinnedNodesHoldWaterAndStayPinned) {
  wetcloth::ClothPatch patch = squarePatch(5);
  patch.pinnedNodes = {0, 6, 13};
  BodyScene scene(GetParam(), patch);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(3, 0.5)));
  wetcloth::Absorption::Parameters parameters;
  parameters.waterVelocity = btVector3(2, -9, 0);
  cloth.add<wetcloth::Absorption>(parameters);
  const std::vector<btScalar> before = stateOf(scene.body());
  scene.bullet().step(240);
  for (const int i : patch.pinnedNodes) {
    EXPECT_EQ(scene.body().m_nodes[i].m_im, 0);
    EXPECT_NEAR(cloth.saturation(i), 1 - std::exp(-2), 1e-5);
    EXPECT_GT(cloth.dryMass(i), 0);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(scene.body().m_nodes[i].m_x[axis], before[std::size_t(6 * i + 2 * axis)]) << i;
    }
  }
}

// Water that leaves has the node's velocity: the node's own does not change.
TEST_IN_EVERY_WORLD(WaterMomentum, LeavingWaterChangesNoVelocity) {
  BodyScene scene(GetParam(), squarePatch(4));
  wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  cloth.setSaturation(1);
  addCall(
      cloth,
      [](wetcloth::WetCloth& wetCloth, const wetcloth::Step&) {
        for (std::size_t i = 0; i < wetCloth.water().size(); ++i) {
          wetCloth.water().drip(i, 0.1 * wetCloth.water().held(i));
          wetCloth.water().evaporate(i, 0.1 * wetCloth.water().held(i));
        }
      },
      wetcloth::Stage::losses);
  scatterVelocities(scene.body());
  const std::vector<btScalar> before = stateOf(scene.body());
  for (int step = 0; step < 10; ++step) wet.preTick(btScalar(0.01));
  EXPECT_LT(cloth.meanSaturation(), 0.2);
  EXPECT_LT(largestDifference(stateOf(scene.body()), before), kTolerance);
}

// The paper's own way makes momentum from nothing: velocities stay while masses grow.
TEST_IN_EVERY_WORLD(WaterMomentum, ThePapersWayKeepsVelocities) {
  BodyScene scene(GetParam(), squarePatch(4));
  wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  cloth.add<wetcloth::Absorption>(wetcloth::Absorption::Parameters::paper());
  scatterVelocities(scene.body());
  const std::vector<btScalar> before = stateOf(scene.body());
  for (int step = 0; step < 10; ++step) wet.preTick(btScalar(0.1));
  EXPECT_GT(cloth.meanSaturation(), 0.05);
  EXPECT_TRUE(sameBits(stateOf(scene.body()), before));
}

}  // namespace
}  // namespace wetcloth_test::water_momentum_test
