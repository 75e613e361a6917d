// SPDX-License-Identifier: Zlib
// The soft-rigid and soft-multibody worlds hand the step to their solver as a float even in Bullet's float64 build, so
// motion agrees with closed forms to 1e-8 or so. Water does not go through that solver and must not lose digits.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

namespace wetcloth_test::float_step_test {

namespace {

constexpr double kDt = 1.0 / 240;  // not a float

#ifdef BT_USE_DOUBLE_PRECISION  // elsewhere the step is a float anyway

// Velocity after one step of free fall over -g dt, less one.
double errorOfOneStep(WorldKind kind) {
  BodyScene scene(kind, squarePatch(2));
  scene.bullet().step(1, btScalar(kDt));
  return meanVelocity(scene.body()).y() / (-9.81 * kDt) - 1;
}

// The fact.
TEST(FloatStep, InPlainBulletOnlyTheDeformableWorldKeepsTheStepsDigits) {
  const double lost = std::fabs(double(float(kDt)) / kDt - 1);
  ASSERT_GT(lost, 1e-10);
  EXPECT_NEAR(std::fabs(errorOfOneStep(WorldKind::softRigid)), lost, 0.01 * lost);
  EXPECT_NEAR(std::fabs(errorOfOneStep(WorldKind::softMultiBody)), lost, 0.01 * lost);
  EXPECT_LT(std::fabs(errorOfOneStep(WorldKind::deformable)), 1e-13);
}

#endif

TEST_IN_EVERY_WORLD(WaterKeepsItsDigits, WhateverTheSolverDoesToTheStep) {
  BodyScene scene(GetParam(), squarePatch(3));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(0.84, 2.0));
  cloth.add<wetcloth::Absorption>();
  scene.bullet().step(480, btScalar(kDt));
  // The application's own step, as Bullet's scalar holds it.
  const double expected = 1 - std::exp(-480 * double(btScalar(kDt)) / 2.0);
  EXPECT_NEAR(cloth.saturation(4), expected, 1e-12 * expected);
  EXPECT_NEAR(cloth.meanSaturation(), expected, 1e-12 * expected);
}

}  // namespace
}  // namespace wetcloth_test::float_step_test
