// SPDX-License-Identifier: Zlib
// What a bond gives of an impulse, and what Cling asks of its parameters and of a body.

#include "bullet_wetcloth/bullet/Contacts.h"
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/ContactScene.h"
#include "tests/support/Rejection.h"
#include "tests/support/RigidBody.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wetcloth_test::cling_law_test {
namespace {

using wetcloth::BondImpulse;
using wetcloth::bondImpulse;
using wetcloth::Cling;

// --- free function --------------------------------------------------------------------------------------------------

TEST(Bond, PullsUpToItsLimitAndThenLetsGo) {
  const btVector3 normal(0, -1, 0);
  const BondImpulse held = bondImpulse({0, btScalar(0.9), 0}, normal, 1, 0);
  EXPECT_FALSE(held.breaks);
  EXPECT_EQ(held.impulse, btVector3(0, btScalar(0.9), 0));
  const BondImpulse broken = bondImpulse({btScalar(0.1), btScalar(1.1), 0}, normal, 1, 5);
  EXPECT_TRUE(broken.breaks);
  EXPECT_EQ(broken.impulse, btVector3(0, 0, 0)) << "no kick, along the surface neither";
}

TEST(Bond, SlidesBeyondItsShearStrength) {
  const btVector3 normal(0, 1, 0);
  const BondImpulse held = bondImpulse({3, 0, 4}, normal, 1, 5.001);
  EXPECT_FALSE(held.slides);
  EXPECT_EQ(held.impulse, btVector3(3, 0, 4));
  const BondImpulse slides = bondImpulse({3, btScalar(-0.5), 4}, normal, 1, 2.5);
  EXPECT_TRUE(slides.slides);
  EXPECT_NEAR(double((slides.impulse - btVector3(1.5, -0.5, 2)).length()), 0, 1e-6);  // rounding of btScalar
}

TEST(Bond, NeverPushesAway) { EXPECT_EQ(bondImpulse({0, 7, 0}, {0, 1, 0}, 1, 1).impulse, btVector3(0, 0, 0)); }

TEST(Bond, LetsGoOfWhatIsNotFinite) {
  const btScalar nan = std::numeric_limits<btScalar>::quiet_NaN();
  const btScalar infinity = std::numeric_limits<btScalar>::infinity();
  for (const btVector3& bad : {btVector3(nan, 0, 0), btVector3(infinity, 0, 0), btVector3(0, infinity, 0)}) {
    const BondImpulse bond = bondImpulse(bad, {0, 1, 0}, 1, 1);
    EXPECT_TRUE(bond.breaks);
    EXPECT_EQ(bond.impulse, btVector3(0, 0, 0));
  }
}

// --- bad input ------------------------------------------------------------------------------------------------------

TEST(ClingParameters, AreChecked) {
  const double nan = std::nan("");
  const auto why = [](auto change) {
    Cling::Parameters parameters;
    change(parameters);
    return rejection([&] { Cling cling(parameters); });
  };
  EXPECT_EQ(why([](auto& p) { p.adhesion = -1; }), "Cling.adhesion = -1: must be finite and >= 0");
  EXPECT_NE(why([&](auto& p) { p.adhesion = nan; }), "");
  EXPECT_EQ(why([](auto& p) { p.shearStrength = -2; }), "Cling.shearStrength = -2: must be finite and >= 0");
  EXPECT_EQ(why([](auto& p) { p.minimumSaturation = 1; }), "Cling.minimumSaturation = 1: must be in [0, 1)");
  EXPECT_EQ(why([](auto& p) { p.peakSaturation = 0.1; }),
            "Cling.peakSaturation = 0.1: must be in (minimumSaturation, 1]");
  EXPECT_NE(why([&](auto& p) { p.peakSaturation = nan; }), "");
  EXPECT_EQ(why([](auto& p) { p.floodedShare = 2; }), "Cling.floodedShare = 2: must be in [0, 1]");
  Cling cling({});
  EXPECT_THROW(cling.setParameters({-1}), std::invalid_argument);
  EXPECT_EQ(cling.parameters().adhesion, 50);
  EXPECT_EQ(cling.share(0.1), 0);
  EXPECT_DOUBLE_EQ(cling.share(0.3), 0.5);
  EXPECT_DOUBLE_EQ(cling.share(0.5), 1);
  EXPECT_DOUBLE_EQ(cling.share(1), 0.5);
}

TEST(ClingOnABody, NodesThatAreNotFiniteDoNotSpoilTheRigidBody) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, Lying().builder(WorldKind::softRigid));
  RigidBody slab(scene.bullet(), box(5, 0.5, 5), 1000, {0, btScalar(-0.5), 0});
  slab.body().setGravity({0, 0, 0});
  scene.cloth().setSaturation(0.5);
  Cling& cling = scene.cloth().add<Cling>();
  scene.step(5);
  ASSERT_EQ(cling.bonds(), 16);
  for (const int i : {3, 7}) scene.node(i).m_x.setX(std::numeric_limits<btScalar>::quiet_NaN());
  scene.preTick(kSubstep);
  EXPECT_EQ(cling.bonds(), 14);
  EXPECT_TRUE(cling.isBonded(2));
  EXPECT_FALSE(cling.isBonded(3));
  EXPECT_TRUE(std::isfinite(slab.body().getLinearVelocity().length()));
  EXPECT_TRUE(std::isfinite(slab.body().getAngularVelocity().length()));
}

TEST(ClingOnABody, SaysWhyItCannotWork) {
  using Flags = btSoftBody::fCollision;
  const auto why = [](WorldKind kind, int flags) {
    ClothScene scene(kind, kEarthGravity, Lying().builder(kind));
    scene.body().m_cfg.collisions = flags;
    return rejection([&] { scene.cloth().add<Cling>(); });
  };
  EXPECT_NE(why(WorldKind::softRigid, Flags::CL_RS).find("clusters"), std::string::npos);
  EXPECT_NE(why(WorldKind::deformable, Flags::SDF_RD | Flags::SDF_RDF).find("SDF_RDN"), std::string::npos);
  EXPECT_NE(why(WorldKind::deformable, Flags::SDF_RS).find("SDF_RD"), std::string::npos);
}

}  // namespace
}  // namespace wetcloth_test::cling_law_test
