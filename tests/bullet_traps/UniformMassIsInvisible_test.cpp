// SPDX-License-Identifier: Zlib
// Position-based links see only the ratios of masses, and gravity is an acceleration: a cloth that hangs under
// nothing but its own weight does the same dry and wet. Nothing may fake a sag there.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

namespace wetcloth_test::uniform_mass_is_invisible_test {

namespace {

// The fact. 2 is a power of the float's base, so not even rounding differs.
TEST_IN_POSITION_BASED_WORLDS(UniformMassIsInvisible, InPlainBullet) {
  BodyScene light(GetParam(), hangingPatch(8));
  BodyScene heavy(GetParam(), [](btSoftBodyWorldInfo& info) {
    wetcloth::ClothPatch patch = hangingPatch(8);
    patch.arealDensity *= 2;
    return patch.build(info);
  });
  light.bullet().step(240);
  heavy.bullet().step(240);
  EXPECT_TRUE(sameBits(stateOf(light.body()), stateOf(heavy.body())));
}

TEST_IN_POSITION_BASED_WORLDS(UniformMassIsInvisible, AWetClothHangsLikeADryOne) {
  BodyScene dry(GetParam(), hangingPatch(8));
  BodyScene soaked(GetParam(), hangingPatch(8));
  wetcloth::WetClothWorld wet(soaked.world());
  wetcloth::WetCloth& cloth = wet.add(soaked.body(), fabricOf(1, 10));
  dry.bullet().step(120);
  soaked.bullet().step(120);
  cloth.setSaturation(1);  // twice as heavy
  dry.bullet().step(240);
  soaked.bullet().step(240);
  EXPECT_TRUE(sameBits(stateOf(soaked.body()), stateOf(dry.body())));
}

TEST_IN_POSITION_BASED_WORLDS(UniformMassIsInvisible, AClothThatSoaksEvenlyHangsLikeADryOne) {
  BodyScene dry(GetParam(), hangingPatch(8));
  BodyScene soaked(GetParam(), hangingPatch(8));
  wetcloth::WetClothWorld wet(soaked.world());
  wetcloth::WetCloth& cloth = wet.add(soaked.body(), fabricOf(5, 0.3));
  wetcloth::Absorption::Parameters still;
  still.conservesMomentum = false;  // water at rest would slow the cloth down
  cloth.add<wetcloth::Absorption>(still);
  dry.bullet().step(360);
  soaked.bullet().step(360);
  ASSERT_GT(cloth.meanSaturation(), 0.99);
  // Masses round now, and a hanging cloth swings for long; a stale link constant shows as centimetres.
  EXPECT_NEAR(totalLength(soaked.body()) / totalLength(dry.body()), 1, 1e-3);
  EXPECT_NEAR(meanPosition(soaked.body()).y(), meanPosition(dry.body()).y(), 1e-3);
}

}  // namespace
}  // namespace wetcloth_test::uniform_mass_is_invisible_test
