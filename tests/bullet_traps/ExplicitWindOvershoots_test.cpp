// SPDX-License-Identifier: Zlib
// An explicit wind on light, dry nodes overshoots the speed of the air: the force of the start of the step acts for
// the whole of it. So ours is semi-implicit, and the explicit one is kept only for the comparison.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

#include <algorithm>

namespace wetcloth_test::explicit_wind_overshoots_test {

namespace {

constexpr double kAir = 10;  // [m/s]

// Fastest that a free sheet of 10 g/m^2 moves in air of 10 m/s at 60 steps per second.
double fastest(WorldKind kind, wetcloth::Wind::Integration integration, wetcloth::Wind::Law law) {
  wetcloth::ClothPatch patch = sailPatch(5);
  patch.arealDensity = 0.010;
  BodyScene scene(kind, patch, btVector3(0, 0, 0));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::Wind::Parameters wind;
  wind.velocity = btVector3(0, 0, btScalar(kAir));
  wind.law = law;
  wind.linearDrag = 7.2;  // 1/2 rho C_d |u| at the start
  wind.integration = integration;
  wet.add(scene.body()).add<wetcloth::Wind>(wind);
  double result = 0;
  for (int step = 0; step < 30; ++step) {
    scene.bullet().step(1, btScalar(1) / 60);
    result = std::max(result, largestSpeed(scene.body()));
  }
  return result;
}

// The fact: force 72 N/m^2 over 0.01 kg/m^2 for 1/60 s is 120 m/s.
TEST_IN_EVERY_WORLD(ExplicitWindOvershoots, ByALot) {
  EXPECT_GT(fastest(GetParam(), wetcloth::Wind::Integration::explicitEuler, wetcloth::Wind::Law::quadratic), 2 * kAir);
  EXPECT_GT(fastest(GetParam(), wetcloth::Wind::Integration::explicitEuler, wetcloth::Wind::Law::linear), 2 * kAir);
}

TEST_IN_EVERY_WORLD(ExplicitWindOvershoots, TheDefaultDoesNot) {
  const wetcloth::Wind::Parameters defaults;
  for (const wetcloth::Wind::Law law : {wetcloth::Wind::Law::quadratic, wetcloth::Wind::Law::linear}) {
    const double speed = fastest(GetParam(), defaults.integration, law);
    EXPECT_LT(speed, kAir * (1 + 1e-5));  // rounding, and the deformable solver's tolerance
    EXPECT_GT(speed, 0.8 * kAir) << "and it does blow";
  }
}

}  // namespace
}  // namespace wetcloth_test::explicit_wind_overshoots_test
