// SPDX-License-Identifier: Zlib
// Bullet's own aerodynamics: the two-sided models grow as the cube of the speed, and all clamp by the node's absolute
// speed, so that wind never moves a cloth at rest. Ours stands on its own, and a body that has both feels both.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

namespace wetcloth_test::bullet_aero_test {

namespace {

// What the air takes, in one step, from a sheet that moves through it broadside [m/s].
double lossInOneStep(btSoftBody::eAeroModel::_ model, double bulletCoefficient, bool withOurs, double speed) {
  BodyScene scene(WorldKind::softRigid, sailPatch(4), kNoGravity);
  scene.body().m_cfg.aeromodel = model;
  scene.body().m_cfg.kDG = btScalar(bulletCoefficient);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  if (withOurs) cloth.add<wetcloth::Wind>({btVector3(0, 0, 0)});
  scene.bullet().step(1);  // Bullet has normals and areas from now on
  scene.body().setVelocity(btVector3(0, 0, btScalar(speed)));
  scene.bullet().step(1);
  return speed - double(meanVelocity(scene.body()).z());
}

double bulletLoss(btSoftBody::eAeroModel::_ model, double speed) { return lossInOneStep(model, 0.01, false, speed); }
double ourLoss(double speed) { return lossInOneStep(btSoftBody::eAeroModel::V_Point, 0, true, speed); }

// The fact.
TEST(BulletAero, InPlainBulletTheTwoSidedModelsGrowAsTheCubeOfTheSpeed) {
  // Each lost speed is known to a few roundings of the speed itself.
  for (const auto model : {btSoftBody::eAeroModel::F_TwoSided, btSoftBody::eAeroModel::V_TwoSided}) {
    EXPECT_NEAR(bulletLoss(model, 2) / bulletLoss(model, 1), 8, 0.1);
  }
}

// The fact.
TEST(BulletAero, InPlainBulletNoModelMovesAClothAtRest) {
  for (const auto model : {btSoftBody::eAeroModel::V_TwoSided, btSoftBody::eAeroModel::V_TwoSidedLiftDrag,
                           btSoftBody::eAeroModel::F_TwoSided, btSoftBody::eAeroModel::F_TwoSidedLiftDrag}) {
    BodyScene scene(WorldKind::softRigid, sailPatch(4), kNoGravity);
    scene.body().m_cfg.aeromodel = model;
    scene.body().m_cfg.kDG = 1;
    scene.body().setWindVelocity(btVector3(0, 0, 30));
    scene.bullet().step(3);
    // The links' rounding moves the nodes by micrometres per second, which the clamp lets grow by 0.8 each step.
    EXPECT_LT(meanVelocity(scene.body()).length(), 1e-4) << model;
  }
}

TEST(BulletAero, OurWindMovesAClothAtRest) {
  BodyScene scene(WorldKind::softRigid, sailPatch(4), kNoGravity);
  wetcloth::WetClothWorld wet(scene.world());
  wet.add(scene.body()).add<wetcloth::Wind>({btVector3(0, 0, 30)});
  scene.bullet().step(10);
  EXPECT_GT(meanVelocity(scene.body()).z(), 1);
}

TEST(BulletAero, OurDragGrowsAsTheSquareOfTheSpeed) {
  // 1/2 rho C_d / 0.15 kg/m^2 / 240 Hz = 0.02 per m/s: implicit, so a few per cent less than the square.
  EXPECT_NEAR(ourLoss(0.4) / ourLoss(0.2), 4, 0.1);
}

TEST(BulletAero, AClothWithBothFeelsBoth) {
  const double ours = ourLoss(1);
  const double bullets = bulletLoss(btSoftBody::eAeroModel::F_TwoSided, 1);
  const double both = lossInOneStep(btSoftBody::eAeroModel::F_TwoSided, 0.01, true, 1);
  ASSERT_GT(bullets, 0.01 * ours);
  EXPECT_GT(both, ours + 0.9 * bullets);  // ours comes first and leaves Bullet's a little less speed
  EXPECT_LT(both, ours + bullets);
}

// How to turn Bullet's off: kDG = kLF = 0, its default. Its wind velocity alone then does nothing.
TEST(BulletAero, IsOffByDefault) {
  BodyScene scene(WorldKind::softRigid, sailPatch(4), kNoGravity);
  EXPECT_EQ(scene.body().m_cfg.kDG, 0);
  EXPECT_EQ(scene.body().m_cfg.kLF, 0);
  EXPECT_NEAR(lossInOneStep(btSoftBody::eAeroModel::V_Point, 0, false, 1), 0, 1e-5);
}

TEST(BulletAero, WeLeaveItsSettingsAlone) {
  BodyScene scene(WorldKind::softRigid, sailPatch(4), kNoGravity);
  scene.body().m_cfg.kDG = btScalar(0.25);
  scene.body().m_cfg.kLF = btScalar(0.125);
  scene.body().setWindVelocity(btVector3(1, 2, 3));
  {
    wetcloth::WetClothWorld wet(scene.world());
    wet.add(scene.body()).add<wetcloth::Wind>({btVector3(0, 0, 1)});
    scene.bullet().step(3);
  }
  EXPECT_EQ(scene.body().m_cfg.kDG, btScalar(0.25));
  EXPECT_EQ(scene.body().m_cfg.kLF, btScalar(0.125));
  EXPECT_TRUE(scene.body().getWindVelocity() == btVector3(1, 2, 3));
}

}  // namespace
}  // namespace wetcloth_test::bullet_aero_test
