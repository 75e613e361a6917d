// SPDX-License-Identifier: Zlib
// Drops between a cloth and the ground, as pictures show them.

#include "command/scene/FallingDrops.h"

#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

namespace wetcloth_test::falling_drops_test {
namespace {

using command::FallingDrops;
using command::Scene;
using wetcloth::Dripping;

constexpr double kDropMass = 4e-5;  // [kg]

/// A saturated patch, whose drops an effect with these parameters lets fall at once, 1 m above the origin.
class Dripper {
 public:
  explicit Dripper(const Scene& scene)
      : drops(scene),
        m_cloth(WorldKind::softRigid, scene.gravity, patch(), wetcloth::Fabric::cotton(), wetcloth::Hook::manual) {
    Dripping::Parameters parameters;
    parameters.holdingSaturation = 0.5;
    parameters.timeConstant = 1e-3;
    parameters.dropMass = kDropMass;
    m_dripping = &m_cloth.cloth().add<Dripping>(parameters);
    m_cloth.cloth().setSaturation(1);
    drops.follow(*m_dripping);
  }

  void dripOnce() { m_cloth.preTick(1.0 / 60); }
  long long count() const { return m_dripping->drops(); }
  ClothScene& cloth() { return m_cloth; }

  FallingDrops drops;

 private:
  static wetcloth::ClothPatch patch() {
    wetcloth::ClothPatch patch = levelPatch(3, 0.2);
    patch.origin += btVector3(0, 1, 0);
    return patch;
  }

  ClothScene m_cloth;
  Dripping* m_dripping = nullptr;
};

Scene sceneWith(std::vector<command::Collider> colliders) {
  Scene scene;
  scene.colliders = std::move(colliders);
  return scene;
}

TEST(FallingDrops, FallAsInAVacuumFromWhereTheyLeft) {
  const Scene scene = sceneWith({});
  Dripper dripper(scene);
  setVelocity(dripper.cloth().body(), btVector3(2, 1, 0));
  dripper.dripOnce();
  ASSERT_GT(dripper.count(), 0);
  for (const double time : {0.0, 0.1, 0.5, 2.9}) {
    const std::vector<command::FallingDrop> drops = dripper.drops.at(time);
    ASSERT_EQ(drops.size(), std::size_t(dripper.count()));
    for (const command::FallingDrop& drop : drops) {
      EXPECT_NEAR(drop.position[1], 1 + time - 9.81 * time * time / 2, 1e-4);
      EXPECT_LE(std::fabs(drop.position[0] - 2 * time), 0.1 + 1e-4);
    }
  }
  EXPECT_TRUE(dripper.drops.at(3.1).empty());  // with nothing below, after 3 s
}

TEST(FallingDrops, AreSpheresOfTheirWater) {
  const Scene scene = sceneWith({});
  Dripper dripper(scene);
  dripper.dripOnce();
  double mass = 0;
  for (const command::FallingDrop& drop : dripper.drops.at(0)) {
    const double radius = drop.radius;
    const double one = 1000 * 4.0 / 3 * 3.14159265 * radius * radius * radius;
    EXPECT_GE(one, kDropMass * (1 - 1e-5));
    mass += one;
  }
  const wetcloth::Ledger ledger = dripper.cloth().cloth().ledger();
  EXPECT_GT(mass, 0);
  EXPECT_LE(mass, ledger.dripped * (1 + 1e-5));
}

TEST(FallingDrops, EndAtTheGround) {
  const Scene scene = sceneWith({command::Plane{btVector3(0, 1, 0), 0.2}, command::Sphere{btVector3(0, 0.5, 0), 0.2}});
  Dripper dripper(scene);
  dripper.dripOnce();
  const double landing = std::sqrt(2 * 0.8 / 9.81);
  EXPECT_EQ(dripper.drops.at(landing - 0.01).size(), std::size_t(dripper.count()));
  EXPECT_TRUE(dripper.drops.at(landing + 0.01).empty());
}

TEST(FallingDrops, EndAtTheWater) {
  Scene scene = sceneWith({command::Plane{btVector3(0, 1, 0), 0}});
  scene.water = command::WaterScene{0.5};
  Dripper dripper(scene);
  dripper.dripOnce();
  const double landing = std::sqrt(2 * 0.5 / 9.81);
  EXPECT_FALSE(dripper.drops.at(landing - 0.01).empty());
  EXPECT_TRUE(dripper.drops.at(landing + 0.01).empty());
}

TEST(FallingDrops, WhatHasLandedIsForgotten) {
  const Scene scene = sceneWith({command::Plane{btVector3(0, 1, 0), 0}});
  Dripper dripper(scene);
  dripper.dripOnce();
  dripper.drops.forgetLanded(0.3);
  EXPECT_FALSE(dripper.drops.at(0.3).empty());
  dripper.drops.forgetLanded(1);
  EXPECT_TRUE(dripper.drops.at(0.3).empty());
}

}  // namespace

}  // namespace wetcloth_test::falling_drops_test
