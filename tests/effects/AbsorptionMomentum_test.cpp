// SPDX-License-Identifier: Zlib
// Water that arrives brings its own velocity: v' = (m v + dm u) / (m + dm).

#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

#include <cmath>

namespace wetcloth_test::absorption_momentum_test {
namespace {

using wetcloth::Absorption;
using wetcloth::Fabric;
using wetcloth::Hook;

// A component of a velocity is rounded once per commit: 1e-16 in float64, 6e-8 in float32; allowed are
// 1e-12 and 1e-5.
constexpr double kRounding = kIsDouble ? 1e-12 : 1e-5;

Absorption::Parameters waterAt(const btVector3& velocity) {
  Absorption::Parameters parameters;
  parameters.waterVelocity = velocity;
  return parameters;
}

TEST(AbsorptionMomentum, EachNodeMixesItsOwnWithTheWaters) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(3, 1), Fabric::cotton(), Hook::manual);
  const btVector3 water(btScalar(0.5), -3, btScalar(0.25));
  scene.cloth().add<Absorption>(waterAt(water));
  for (int i = 0; i < 9; ++i) scene.node(i).m_v = btVector3(btScalar(i), btScalar(1 - i), btScalar(0.5 * i));

  scene.preTick(4);

  for (int i = 0; i < 9; ++i) {
    const double dry = scene.cloth().dryMass(i);
    const double wet = scene.cloth().held(i);
    ASSERT_GT(wet, 0.2 * dry);
    const double before[] = {double(i), 1.0 - i, 0.5 * i};
    for (int k = 0; k < 3; ++k) {
      const double expected = (dry * before[k] + wet * double(water[k])) / (dry + wet);
      EXPECT_NEAR(scene.node(i).m_v[k], expected, 10 * kRounding) << i << " " << k;
    }
  }
}

TEST(AbsorptionMomentum, TotalIsConservedOverManySmallArrivals) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(5, 1), Fabric::highAbsorption(), Hook::manual);
  const btVector3 water(0, -2, 1);
  scene.cloth().add<Absorption>(waterAt(water));
  setVelocity(scene.body(), btVector3(3, 1, 0));
  const auto before = momentum(scene.body());

  for (int i = 0; i < 1000; ++i) scene.preTick(0.005);

  const double arrived = scene.cloth().ledger().absorbed;
  ASSERT_GT(arrived, scene.cloth().totalMass() / 2);
  const auto after = momentum(scene.body());
  const double scale = scene.cloth().totalMass() * 3;
  for (int k = 0; k < 3; ++k) {
    const auto c = std::size_t(k);
    // float32 rounds a velocity 1000 times, always the same way at worst: 1000 x 6e-8.
    EXPECT_NEAR(after[c], before[c] + arrived * double(water[k]), scale * (kIsDouble ? 1e-12 : 6e-5)) << k;
  }
}

TEST(AbsorptionMomentum, WaterAtTheClothsVelocityChangesNothing) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(3, 1), Fabric::cotton(), Hook::manual);
  scene.cloth().add<Absorption>(waterAt(btVector3(3, -1, 2)));
  setVelocity(scene.body(), btVector3(3, -1, 2));
  scene.preTick(5);
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR((scene.node(i).m_v - btVector3(3, -1, 2)).length(), 0, 3 * kRounding);
  }
}

TEST(AbsorptionMomentum, PaperModeLeavesVelocitiesAsTheyAreToTheBit) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(3, 1), Fabric::tableII(), Hook::manual);
  Absorption::Parameters parameters = Absorption::Parameters::paper();
  EXPECT_FALSE(parameters.conservesMomentum);
  EXPECT_EQ(parameters.law, Absorption::Law::ramp);
  parameters.waterVelocity = btVector3(0, -5, 0);
  scene.cloth().add<Absorption>(parameters);
  const btVector3 velocity(btScalar(0.1), btScalar(-0.7), btScalar(0.3));
  setVelocity(scene.body(), velocity);
  for (int i = 0; i < 5; ++i) scene.preTick(1);
  EXPECT_NEAR(scene.cloth().saturation(0), 0.5, 1e-14);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(scene.node(i).m_v, velocity);
}

/// Lets all water go at once.
class DripsDry : public wetcloth::Effect {
 public:
  const char* name() const override { return "DripsDry"; }
  wetcloth::Stage stage() const override { return wetcloth::Stage::losses; }
  void apply(wetcloth::WetCloth& cloth, const wetcloth::Step&) override {
    for (int i = 0; i < cloth.nodeCount(); ++i) cloth.water().drip(std::size_t(i), cloth.held(i));
  }
};

TEST(AbsorptionMomentum, WaterThatLeavesTakesTheNodesVelocity) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(3, 1), Fabric::cotton(), Hook::manual);
  scene.cloth().setSaturation(1);
  const btVector3 velocity(2, -1, 0);
  setVelocity(scene.body(), velocity);
  const double before = freeMass(scene.body());
  scene.cloth().add(std::make_unique<DripsDry>());
  scene.preTick(1);
  EXPECT_NEAR(freeMass(scene.body()) / before, 1 / 1.84, 1e-6);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(scene.node(i).m_v, velocity);
}

TEST(AbsorptionMomentum, SettingSaturationByHandKeepsVelocities) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(3, 1), Fabric::cotton(), Hook::manual);
  const btVector3 velocity(2, -1, 0);
  setVelocity(scene.body(), velocity);
  scene.cloth().setSaturation(0.7);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(scene.node(i).m_v, velocity);
}

// A cloth that flies freely and takes up water at rest: M v stays, so v = v0 M0 / M.
TEST_IN_EVERY_WORLD(AbsorptionMomentumInWorld, WaterAtRestSlowsAFlyingClothDown) {
  ClothScene scene(GetParam(), btVector3(0, 0, 0), levelPatch(5, 1));
  scene.cloth().add<Absorption>();
  setVelocity(scene.body(), btVector3(2, 1, 0));
  scene.step(512, kExactSubstep);
  const double ratio = 1 + 0.84 * -std::expm1(-2 / 8.844);
  // Bullet takes velocities from positions: float32 rounds at 4 m to 5e-7 m, over the substep of 4 ms that is
  // 1e-4 m/s for a step.
  const double tolerance = kIsDouble ? 1e-9 : 5e-4;
  for (int i = 0; i < 25; ++i) {
    EXPECT_NEAR(scene.node(i).m_v.x(), 2 / ratio, tolerance) << i;
    EXPECT_NEAR(scene.node(i).m_v.y(), 1 / ratio, tolerance) << i;
  }
}

}  // namespace
}  // namespace wetcloth_test::absorption_momentum_test
