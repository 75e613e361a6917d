// SPDX-License-Identifier: Zlib
// What water does to a cloth in one step: buoyancy, resistance, the waterline, where there is no water; bad input.

#include "bullet_wetcloth/effects/WaterDrag.h"

#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"
#include "tests/support/SoftBodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace wetcloth_test::water_drag_test {
namespace {

using wetcloth::displacedVolume;
using wetcloth::Fabric;
using wetcloth::Hook;
using wetcloth::sinkingSpeed;
using wetcloth::WaterDrag;
using wetcloth::WaterSurface;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Water up to this height [m].
WaterDrag::Parameters waterUpTo(double height, const btVector3& current = kNoGravity) {
  WaterSurface surface;
  surface.offset = -height;
  surface.velocity = current;
  WaterDrag::Parameters parameters;
  parameters.surface = surface;
  return parameters;
}

// float32 sums some hundred triangles, each rounded to 1e-7.
constexpr double kSum = kIsDouble ? 1e-10 : 1e-5;

// --- free functions -------------------------------------------------------------------------------------------

TEST(WaterDragFormulas, VolumeOfFibreAndWater) {
  EXPECT_DOUBLE_EQ(displacedVolume(1.54, 1540, 0), 1e-3);
  EXPECT_DOUBLE_EQ(displacedVolume(1.54, 1540, 2), 3e-3);
}

TEST(WaterDragFormulas, SinkingSpeedBalancesWeightAndResistance) {
  const double speed = sinkingSpeed(0.150, 1540, 1000, 1.2, 9.81);
  EXPECT_NEAR(speed, 0.0293, 0.0001);
  EXPECT_NEAR(0.5 * 1000 * 1.2 * speed * speed, 9.81 * (0.150 - 1000 * displacedVolume(0.150, 1540, 0)), 1e-14);
  EXPECT_NEAR(sinkingSpeed(0.150, 1000 / (2 - 1000 / 1540.0), 1000, 1.2, 9.81), -speed, 1e-14) << "lighter fibre rises";
  EXPECT_EQ(sinkingSpeed(0.150, 1000, 1000, 1.2, 9.81), 0);
  EXPECT_EQ(sinkingSpeed(0.150, 1540, 1000, 1.2, 0), 0);
}

// --- buoyancy ---------------------------------------------------------------------------------------------------

TEST(WaterDragBuoyancy, IsTheWeightOfTheDisplacedWater) {
  for (const double saturation : {0.0, 0.5, 1.0}) {
    for (const double density : {1000.0, 1025.0}) {
      ClothScene scene(WorldKind::softRigid, kEarthGravity, levelPatch(9, 1), Fabric::cotton(), Hook::manual);
      scene.cloth().setSaturation(saturation);
      WaterDrag::Parameters parameters = waterUpTo(5);
      parameters.surface->density = density;
      parameters.dragCoefficient = parameters.skinFriction = 0;
      WaterDrag& effect = scene.cloth().add<WaterDrag>(parameters);
      scene.preTick(1.0 / 240);
      const double expected = 9.81 * density * (0.150 / 1540 + saturation * 0.84 * 0.150 / 1000);
      EXPECT_NEAR(double(effect.totalForce().y()) / expected, 1, kIsDouble ? 1e-7 : 1e-5);  // 9.81 rounded
      const double gained = momentum(scene.body())[1];
      EXPECT_NEAR(gained / (expected / 240), 1, kIsDouble ? 1e-7 : 1e-5);
    }
  }
}

TEST(WaterDragBuoyancy, FibreAsDenseAsWaterFloatsWetAndDry) {
  for (const double saturation : {0.0, 1.0}) {
    ClothScene scene(WorldKind::softRigid, kEarthGravity, levelPatch(5, 1), Fabric::cotton(), Hook::manual);
    scene.cloth().setSaturation(saturation);
    WaterDrag::Parameters parameters = waterUpTo(5);
    parameters.fibreDensity = 1000;
    scene.cloth().add<WaterDrag>(parameters);
    scene.preTick(0.125);
    for (int i = 0; i < 25; ++i) {
      EXPECT_NEAR(double(scene.node(i).m_v.y()), 9.81 * 0.125, 9.81 * kSum) << "what gravity will take";
    }
  }
}

TEST(WaterDragBuoyancy, IsAgainstGravityHoweverTheSurfaceIsTilted) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, levelPatch(5, 1), Fabric::cotton(), Hook::manual);
  WaterDrag::Parameters parameters = waterUpTo(5);
  parameters.surface->normal = btVector3(btScalar(0.6), btScalar(0.8), 0);
  WaterDrag& effect = scene.cloth().add<WaterDrag>(parameters);
  scene.preTick(1e-4);
  EXPECT_EQ(effect.totalForce().x(), 0);
  EXPECT_GT(effect.totalForce().y(), 0);
}

// --- resistance -------------------------------------------------------------------------------------------------

/// The force of one substep of 1e-4 s on a cloth without gravity that is too heavy to move in it.
btVector3 forceOn(wetcloth::ClothPatch patch, const WaterDrag::Parameters& parameters) {
  patch.arealDensity = 1e6;
  ClothScene scene(WorldKind::softRigid, kNoGravity, patch, Fabric::cotton(), Hook::manual);
  WaterDrag& effect = scene.cloth().add<WaterDrag>(parameters);
  scene.preTick(1e-4);
  return effect.totalForce();
}

// 1e-5: the cloth's own motion in the step.
TEST(WaterDragResistance, OfASheetAcrossTheCurrentIsPressureTimesArea) {
  WaterDrag::Parameters parameters = waterUpTo(5, btVector3(0, 2, 0));
  EXPECT_NEAR(double(forceOn(levelPatch(17, 2), parameters).y()) / (0.5 * 1000 * 1.2 * 4 * 4), 1, 1e-5);
  parameters.surface->velocity = btVector3(0, -2, 0);
  EXPECT_NEAR(double(forceOn(levelPatch(17, 2), parameters).y()) / (-0.5 * 1000 * 1.2 * 4 * 4), 1, 1e-5);
  parameters.dragCoefficient = 0.3;
  parameters.surface->density = 800;
  EXPECT_NEAR(double(forceOn(levelPatch(17, 2), parameters).y()) / (-0.5 * 800 * 0.3 * 4 * 4), 1, 1e-5);
}

TEST(WaterDragResistance, OfASheetAlongTheCurrentIsSkinFriction) {
  const btVector3 force = forceOn(levelPatch(9, 2), waterUpTo(5, btVector3(3, 0, 4)));
  const double size = 0.5 * 1000 * 0.01 * 4 * 25;
  EXPECT_NEAR(double(force.x()) / (0.6 * size), 1, 1e-4);
  EXPECT_NEAR(double(force.z()) / (0.8 * size), 1, 1e-4);
  EXPECT_NEAR(double(force.y()), 0, 1e-4 * size);
}

TEST(WaterDragResistance, OnlyTheRelativeSpeedCounts) {
  ClothScene scene(WorldKind::softRigid, kNoGravity, levelPatch(9, 1), Fabric::cotton(), Hook::manual);
  const btVector3 current(3, 4, -1);
  WaterDrag& effect = scene.cloth().add<WaterDrag>(waterUpTo(5, current));
  setVelocity(scene.body(), current);
  scene.preTick(kSubstep);
  EXPECT_EQ(effect.totalForce(), kNoGravity);
  for (int i = 0; i < 81; ++i) EXPECT_EQ(scene.node(i).m_v, current);
}

TEST(WaterDragResistance, PinnedNodesDoNotMove) {
  wetcloth::ClothPatch patch = levelPatch(5, 1);
  patch.pinnedCorners = {wetcloth::ClothPatch::Corner::bottomLeft};
  ClothScene scene(WorldKind::softRigid, kEarthGravity, patch, Fabric::cotton(), Hook::manual);
  scene.cloth().add<WaterDrag>(waterUpTo(5, btVector3(0, 2, 0)));
  scene.preTick(kSubstep);
  EXPECT_EQ(scene.node(0).m_v, kNoGravity);
  EXPECT_GT(scene.node(1).m_v.y(), 0);
}

// --- the waterline ----------------------------------------------------------------------------------------------

TEST(WaterDragWaterline, OnlyWhatIsBelowFeelsTheWater) {
  wetcloth::ClothPatch patch = sailPatch(9);  // rows at y = 0, 1/8 .. 1
  patch.arealDensity = 1e6;
  ClothScene scene(WorldKind::softRigid, kNoGravity, patch, Fabric::cotton(), Hook::manual);
  WaterDrag& effect = scene.cloth().add<WaterDrag>(waterUpTo(0.5 + 1.0 / 16, btVector3(0, 0, 2)));
  scene.preTick(1e-4);
  double immersedArea = 0;
  const std::vector<double> areas = scene.cloth().restMesh().nodeAreas();
  for (int i = 0; i < 81; ++i) {
    const bool isBelow = scene.node(i).m_x.y() < btScalar(0.55);
    immersedArea += isBelow ? areas[std::size_t(i)] : 0;
    EXPECT_EQ(scene.node(i).m_v.z() > 0, isBelow) << i;
  }
  EXPECT_NEAR(immersedArea, 0.5 + 1.0 / 16, 1e-6);
  EXPECT_NEAR(double(effect.totalForce().z()) / (0.5 * 1000 * 1.2 * immersedArea * 4), 1, 1e-4);
}

TEST(WaterDragWaterline, ANormalOfAnyLengthIsTheSameSurface) {
  WaterDrag::Parameters parameters = waterUpTo(0.3, btVector3(0, 0, 2));
  const btVector3 expected = forceOn(sailPatch(9), parameters);
  parameters.surface->normal *= 4;
  parameters.surface->offset *= 4;
  EXPECT_EQ(forceOn(sailPatch(9), parameters), expected);
}

TEST(WaterDragWaterline, AClothAboveTheWaterCostsNoTrianglesAndFarAboveNoNodes) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, levelPatch(5, 1), Fabric::cotton(), Hook::manual);
  WaterDrag& effect = scene.cloth().add<WaterDrag>(waterUpTo(-0.1));
  for (int i = 0; i < 10; ++i) scene.preTick(kSubstep);
  EXPECT_EQ(effect.trianglesVisited(), 0);
  EXPECT_EQ(effect.nodesVisited(), 10 * 25);
  adjust(effect, [&](auto& p) { p.surface = *waterUpTo(-5).surface; });
  for (int i = 0; i < 10; ++i) scene.preTick(kSubstep);
  EXPECT_EQ(effect.nodesVisited(), 10 * 25);
  for (int i = 0; i < 25; ++i) EXPECT_EQ(scene.node(i).m_v, kNoGravity);
  adjust(effect, [&](auto& p) { p.surface = *waterUpTo(0.1).surface; });
  scene.preTick(kSubstep);
  EXPECT_EQ(effect.trianglesVisited(), 32);
  EXPECT_GT(effect.totalForce().y(), 0);
  adjust(effect, [&](auto& p) { p.surface = *waterUpTo(-5).surface; });
  scene.preTick(kSubstep);
  EXPECT_EQ(effect.totalForce(), kNoGravity) << "of the last step";
}

// --- Bullet's own water -----------------------------------------------------------------------------------------

TEST(WaterDragOfBullet, IsUsedWhenNoSurfaceIsGivenAndFollowedWhenItChanges) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, levelPatch(5, 1), Fabric::cotton(), Hook::manual);
  btSoftBodyWorldInfo& info = *scene.body().m_worldInfo;
  info.water_normal = btVector3(0, 1, 0);
  info.water_offset = 1;
  WaterDrag& effect = scene.cloth().add<WaterDrag>();
  scene.preTick(kSubstep);
  EXPECT_EQ(effect.totalForce(), kNoGravity) << "a metre above it";
  info.water_offset = -1;
  scene.preTick(kSubstep);
  EXPECT_GT(effect.totalForce().y(), 0);
  info.water_normal = kNoGravity;
  scene.preTick(kSubstep);
  EXPECT_EQ(effect.totalForce(), kNoGravity) << "drained";
}

TEST(WaterDragOfBullet, ACutAfterItWasDrainedDoesNotEndTheEffect) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, levelPatch(5, 1), Fabric::cotton(), Hook::manual);
  scene.wet().setLog({});
  btSoftBodyWorldInfo& info = scene.bullet().info();
  info.water_normal = btVector3(0, 1, 0);
  info.water_offset = -1;
  WaterDrag& effect = scene.cloth().add<WaterDrag>();
  info.water_normal = kNoGravity;
  const btSoftBody::Face& face = scene.body().m_faces[0];
  ASSERT_TRUE(scene.body().cutLink(face.m_n[0], face.m_n[1], btScalar(0.5)));
  scene.preTick(kSubstep);
  ASSERT_EQ(scene.cloth().effects().size(), 1u);
  info.water_normal = btVector3(0, 1, 0);
  scene.preTick(kSubstep);
  EXPECT_GT(effect.totalForce().y(), 0) << "flooded again";
}

TEST(WaterDragOfBullet, WithoutAnySurfaceIsRefused) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, levelPatch(5, 1), Fabric::cotton(), Hook::manual);
  const std::string message = rejection([&] { scene.cloth().add<WaterDrag>(); });
  EXPECT_EQ(message.find("WaterDrag.surface"), 0u) << message;
  EXPECT_TRUE(scene.cloth().effects().empty());
}

// --- bad input --------------------------------------------------------------------------------------------------

void expectRefused(double WaterDrag::Parameters::*field, const std::string& name, const std::vector<double>& values) {
  for (const double bad : values) {
    WaterDrag::Parameters parameters = waterUpTo(0);
    parameters.*field = bad;
    const std::string message = rejection([&] { WaterDrag{parameters}; });
    EXPECT_EQ(message.find("WaterDrag." + name + " = "), 0u) << bad << ": " << message;
  }
}

TEST(WaterDragBadInput, IsNamed) {
  expectRefused(&WaterDrag::Parameters::dragCoefficient, "dragCoefficient", {-1, kNaN, kInfinity});
  expectRefused(&WaterDrag::Parameters::skinFriction, "skinFriction", {-1, kNaN, kInfinity});
  expectRefused(&WaterDrag::Parameters::fibreDensity, "fibreDensity", {0, -1, kNaN, kInfinity});
  EXPECT_EQ(rejection([] { WaterDrag{waterUpTo(kNaN)}; }).find("WaterDrag.surface.offset"), 0u);
}

TEST(WaterDragBadInput, OfASetterChangesNothing) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, levelPatch(5, 1), Fabric::cotton(), Hook::manual);
  WaterDrag& effect = scene.cloth().add<WaterDrag>(waterUpTo(2));
  WaterSurface bad;
  bad.density = -1;
  EXPECT_EQ(
      rejection([&] { adjust(effect, [&](auto& p) { p.surface = bad; }); }).find("WaterDrag.surface.density = -1"), 0u);
  EXPECT_EQ(effect.parameters().surface->offset, -2);
}

TEST(WaterDragBadInput, ABodyWithoutTrianglesIsRefused) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, hangingRope(3, 0.1, 0.1));
  const std::string message = rejection([&] { scene.cloth().add<WaterDrag>(waterUpTo(0)); });
  EXPECT_NE(message.find("WaterDrag: body.m_faces.size() = 0"), std::string::npos) << message;
}

}  // namespace
}  // namespace wetcloth_test::water_drag_test
