// SPDX-License-Identifier: Zlib
// The formulas alone, and what the effect refuses.

#include "bullet_wetcloth/effects/WetStiffness.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"
#include "tests/support/SoftBodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wetcloth_test::wet_stiffness_law_test {
namespace {

using wetcloth::dampingImpulse;
using wetcloth::dampingShare;
using wetcloth::HookeSprings;
using wetcloth::WetStiffness;
using wetcloth::wetStiffnessFactor;

// A handful of roundings of numbers near 1.
constexpr double kRounding = kIsDouble ? 1e-14 : 1e-6;

TEST(WetStiffnessFactor, IsOneWhenDryAndLinear) {
  EXPECT_EQ(wetStiffnessFactor(0, 0.3), 1);
  EXPECT_NEAR(wetStiffnessFactor(1, 0.3), 0.3, 1e-15);
  EXPECT_NEAR(wetStiffnessFactor(0.5, 0.3), 0.65, 1e-15);
  EXPECT_NEAR(wetStiffnessFactor(0.25, 3), 1.5, 1e-15);
  EXPECT_EQ(wetStiffnessFactor(0.7, 1), 1);
}

TEST(DampingShare, IsExponentialForAnyStep) {
  EXPECT_EQ(dampingShare(0, 1), 0);
  EXPECT_NEAR(dampingShare(3, 1e-9), 3e-9, 1e-17);  // no digit is lost in a small step: 3e-9 - 4.5e-18
  EXPECT_NEAR(1 - dampingShare(2, 0.5), std::exp(-1.0), 1e-15);
  EXPECT_NEAR((1 - dampingShare(2, 0.3)) * (1 - dampingShare(2, 0.7)), std::exp(-2.0), 1e-15);
  EXPECT_EQ(dampingShare(1, 1e6), 1);
}

// After the impulse on both ends, what is left of the relative velocity along the link is 1 - share; what lies across
// it stays.
TEST(DampingImpulse, TakesItsShareAlongTheLinkAndNothingAcross) {
  const btVector3 ab(btScalar(0.3), btScalar(-0.4), btScalar(1.2));
  const btVector3 along = ab.normalized();
  const btVector3 velocity(2, 1, -3);
  for (double share : {0.0, 0.25, 1.0}) {
    const btVector3 impulse = dampingImpulse(ab, velocity, 1 / 0.5 + 1 / 2.0, share);
    const btVector3 after = velocity + impulse / btScalar(2) + impulse / btScalar(0.5);
    EXPECT_NEAR(double(after.dot(along)), (1 - share) * double(velocity.dot(along)), 10 * kRounding);
    EXPECT_LT(double(impulse.cross(along).length()), 10 * kRounding);
  }
}

TEST(DampingImpulse, IsZeroWhereThereIsNoDirectionOrNothingMoves) {
  EXPECT_EQ(dampingImpulse(btVector3(0, 0, 0), btVector3(1, 2, 3), 1, 1), btVector3(0, 0, 0));
  EXPECT_EQ(dampingImpulse(btVector3(1, 0, 0), btVector3(1, 2, 3), 0, 1), btVector3(0, 0, 0));
}

TEST(WetStiffnessInput, BadParametersAreNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (double bad : {0.0, -1.0, 0.0009, 1001.0, nan, infinite}) {
    WetStiffness::Parameters stretch;
    stretch.wetStretch = bad;
    EXPECT_EQ(rejection([&] { WetStiffness{stretch}; }).find("WetStiffness.wetStretch = "), 0u) << bad;
    WetStiffness::Parameters bending;
    bending.wetBending = bad;
    EXPECT_EQ(rejection([&] { WetStiffness{bending}; }).find("WetStiffness.wetBending = "), 0u) << bad;
  }
  for (double bad : {-1e-9, nan, infinite}) {
    WetStiffness::Parameters dry;
    dry.dryDamping = bad;
    EXPECT_EQ(rejection([&] { WetStiffness{dry}; }).find("WetStiffness.dryDamping = "), 0u) << bad;
    WetStiffness::Parameters wet;
    wet.wetDamping = bad;
    EXPECT_EQ(rejection([&] { WetStiffness{wet}; }).find("WetStiffness.wetDamping = "), 0u) << bad;
  }
}

TEST(WetStiffnessInput, ARefusedSetterChangesNothing) {
  WetStiffness effect({});
  adjust(effect, [](auto& p) {
    p.dryDamping = 1;
    p.wetDamping = 2;
  });
  EXPECT_NE(rejection([&] {
              adjust(effect, [](auto& p) {
                p.dryDamping = 3;
                p.wetDamping = -1;
              });
            }).find("wetDamping"),
            std::string::npos);
  EXPECT_EQ(effect.parameters().dryDamping, 1);
  EXPECT_EQ(effect.parameters().wetDamping, 2);
}

TEST(WetStiffnessInput, ABodyWithoutLinksIsRefused) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity,
                   triangles({btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 0, 1)}, {1, 1, 1}, {{0, 1, 2}}));
  EXPECT_NE(rejection([&] { scene.cloth().add<WetStiffness>(); }).find("links"), std::string::npos);
  EXPECT_TRUE(scene.cloth().effects().empty());
}

TEST(WetStiffnessInput, ASecondOneIsRefused) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, levelPatch(4, 1));
  scene.cloth().add<WetStiffness>();
  EXPECT_NE(rejection([&] { scene.cloth().add<WetStiffness>(); }).find("already"), std::string::npos);
  EXPECT_EQ(scene.cloth().effects().size(), 1u);
}

TEST_IN_DEFORMABLE_WORLDS(WetStiffnessInDeformable, NeedsHookeSpringsAndSaysSo) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(4, 1));
  const std::string why = rejection([&] { scene.cloth().add<WetStiffness>(); });
  EXPECT_NE(why.find("HookeSprings"), std::string::npos) << why;
  EXPECT_NE(why.find("deformable"), std::string::npos) << why;
  EXPECT_TRUE(scene.cloth().effects().empty());
  scene.cloth().add<HookeSprings>();
  scene.cloth().add<WetStiffness>();
  EXPECT_EQ(scene.cloth().effects().size(), 2u);
}

TEST_IN_DEFORMABLE_WORLDS(WetStiffnessInDeformable, DampsWithoutThem) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(4, 1));
  EXPECT_EQ(rejection([&] { scene.cloth().add<WetStiffness>({1, 1, 0, 3}); }), "");
}

}  // namespace
}  // namespace wetcloth_test::wet_stiffness_law_test
