// SPDX-License-Identifier: Zlib
// Friction by saturation: the curve, Bullet's own rules with the new coefficient, and how wet cloths slide.

#include "bullet_wetcloth/bullet/Contacts.h"
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/ClothScene.h"
#include "tests/support/ContactScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Rejection.h"
#include "tests/support/RigidBody.h"

namespace wetcloth_test::wet_friction_test {
namespace {

using wetcloth::WetFriction;
using wetcloth::WetnessCurve;

// --- free functions -------------------------------------------------------------------------------------------------

TEST(WetnessCurve, IsLinearBetweenDryPeakAndFlooded) {
  const WetnessCurve curve = {1, 3, 2, 0.4};
  EXPECT_EQ(curve.at(0), 1);
  EXPECT_DOUBLE_EQ(curve.at(0.1), 1.5);
  EXPECT_EQ(curve.at(0.4), 3);
  EXPECT_DOUBLE_EQ(curve.at(0.7), 2.5);
  EXPECT_EQ(curve.at(1), 2);
  EXPECT_EQ(curve.at(1.5), 2) << "over-full";
  EXPECT_EQ((WetnessCurve{1, 3, 2, 1}.at(1)), 3) << "no flooded part";
}

TEST(SlidingShare, IsBulletsRule) {
  EXPECT_EQ(wetcloth::slidingShare(btScalar(0.5), -1, btVector3(btScalar(0.49), 0, 0)), 0) << "inside the cone";
  EXPECT_EQ(wetcloth::slidingShare(btScalar(0.5), -1, btVector3(btScalar(0.51), 0, 0)), btScalar(0.5)) << "outside";
  EXPECT_EQ(wetcloth::slidingShare(0, -1, btVector3(1, 0, 0)), 1) << "nothing holds it";
  EXPECT_EQ(wetcloth::slidingShare(3, btScalar(-0.01), btVector3(1, 0, 0)), 0) << "never turns the motion round";
}

// --- on a slope -----------------------------------------------------------------------------------------------------

/// A cloth on a slope of this tangent: the slope is level, gravity slants along x.
class Slope {
 public:
  Slope(WorldKind kind, double tangent, double clothFriction = 0.4)
      : scene(kind, slanted(tangent), Lying().builder(kind)), m_box(scene.bullet(), box(50, 0.5, 50), 0, {0, -0.5, 0}) {
    m_box.body().setFriction(0.5);
    scene.body().m_cfg.kDF = btScalar(clothFriction);
    scene.addBulletSpringsForStep();
  }

  static btVector3 slanted(double tangent) {
    const double norm = std::hypot(1, tangent);
    return btVector3(btScalar(9.81 * tangent / norm), btScalar(-9.81 / norm), 0);
  }
  double speed() { return momentum(scene.body())[0] / freeMass(scene.body()); }
  /// Down the slope [m/s^2], over steps in which the cloth slides, once it has settled.
  double acceleration() {
    scene.step(40);
    const double before = speed();
    scene.step(40);
    return (speed() - before) / (40 * kSubstep);
  }

  ClothScene scene;

 private:
  RigidBody m_box;
};

TEST_IN_EVERY_WORLD(WetFrictionInWorld, EvenlyWetIsABodyWithTheProductForItsFriction) {
  Slope with(GetParam(), 1.2);
  Slope reference(GetParam(), 1.2, double(btScalar(0.4)) * 2.5);
  Slope dry(GetParam(), 1.2);
  with.scene.cloth().add<WetFriction>();
  for (Slope* slope : {&with, &reference, &dry}) {
    slope->scene.cloth().setSaturation(0.5);
    slope->scene.step(120);
  }
  EXPECT_TRUE(sameBits(stateOf(with.scene.body()), stateOf(reference.scene.body())));
  EXPECT_LT(with.speed(), 0.9 * dry.speed()) << "it makes a difference";
  EXPECT_EQ(with.scene.body().m_cfg.kDF, btScalar(0.4));
}

TEST_IN_EVERY_WORLD(WetFrictionInWorld, DryIsAsIfItWereNotThere) {
  Slope with(GetParam(), 0.3);
  Slope without(GetParam(), 0.3);
  WetFriction& friction = with.scene.cloth().add<WetFriction>();
  with.scene.step(120);
  without.scene.step(120);
  EXPECT_TRUE(sameBits(stateOf(with.scene.body()), stateOf(without.scene.body())));
  EXPECT_GT(friction.contactsVisited(), 0);
}

// How far a wet cloth goes in half a second on a slope of this tangent; its coefficient is 0.4 x 0.5 x 2.5 = 0.5.
double slip(Slope& slope) {
  slope.scene.step(60);
  const double before = centreOfMass(slope.scene.body())[0];
  slope.scene.step(120);
  return centreOfMass(slope.scene.body())[0] - before;
}

TEST_IN_EVERY_WORLD(WetFrictionInWorld, FromRestItStaysBelowTheTangentAndSlidesAboveIt) {
  for (const double share : {0.9, 1.1}) {
    const bool isDeformable = Slope(GetParam(), 0).scene.bullet().isDeformable();
    Slope slope(GetParam(), share * 0.5);
    slope.scene.cloth().add<WetFriction>();
    slope.scene.cloth().setSaturation(0.5);
    if (!isDeformable) {  // which have to come to rest first (see below), pressed on as on the slope
      btVector3& gravity = slope.scene.bullet().info().m_gravity;
      gravity.setX(0);
      slope.scene.step(120);
      gravity = Slope::slanted(share * 0.5);
    }
    const double moved = slip(slope);
    if (share > 1) {
      EXPECT_GT(moved, 5e-3);
    } else if (isDeformable || kIsDouble) {
      // In float32 a node at rest in the position-based worlds is at the margin to rounding, in or out: Bullet lists it
      // in some steps only, it gets moving, and then slides.
      EXPECT_LT(moved, 1e-3);
    }
  }
}

// In the position-based worlds what slides goes at v = g sin dt (1 - mu) / mu (below), and is held when v dt + g sin
// dt^2 < mu g cos dt^2: it stops below a tangent of mu^2, not of mu.
TEST(WetFrictionOfASlidingCloth, StopsBelowTheSquareOfTheCoefficientInThePositionBasedWorlds) {
  for (const WorldKind kind : {WorldKind::softRigid, WorldKind::softMultiBody}) {
    for (const double share : {0.8, 1.5}) {
      Slope slope(kind, share * 0.25);
      slope.scene.cloth().add<WetFriction>();
      slope.scene.cloth().setSaturation(0.5);
      setVelocity(slope.scene.body(), {btScalar(0.1), 0, 0});
      const double moved = slip(slope);
      if (share < 1) {
        EXPECT_LT(moved, 1e-3);
      } else {
        EXPECT_GT(moved, 4e-3) << "0.014 m/s for half a second";
      }
    }
  }
}

// Outside the cone the worlds part. The deformable one is Coulomb's: a = g (sin - mu cos). The position-based ones take
// a share mu of the velocity in each step, so the cloth slides at v = g sin dt (1 - mu) / mu, whatever it weighs.
TEST_IN_EVERY_WORLD(WetFrictionInWorld, SlidesAsItsWorldLetsItSlide) {
  for (const double saturation : {0.0, 0.25, 0.5}) {
    Slope slope(GetParam(), 1.2);
    const WetFriction& friction = slope.scene.cloth().add<WetFriction>();
    slope.scene.cloth().setSaturation(saturation);
    const double mu = 0.2 * friction.factor(saturation);
    const double cosine = 1 / std::hypot(1, 1.2);
    const double sine = 1.2 * cosine;
    const double acceleration = slope.acceleration();
    if (slope.scene.bullet().isDeformable()) {
      const double expected = 9.81 * (sine - mu * cosine);
      EXPECT_NEAR(acceleration, expected, 0.02 * expected) << saturation;  // springs shake a little
    } else {
      const double expected = 9.81 * sine * kSubstep * (1 - mu) / mu;
      // After 80 steps (1 - mu)^80 is left of what is missing, 2e-8. Float32 knows a velocity to 1e-4 m/s.
      EXPECT_NEAR(slope.speed(), expected, 0.01 * expected) << saturation;
    }
  }
}

TEST_IN_EVERY_WORLD(WetFrictionInWorld, AHalfWetClothTurns) {
  Slope slope(GetParam(), 1.2);
  slope.scene.cloth().add<WetFriction>();
  std::vector<double> held;
  for (int i = 0; i < 16; ++i) held.push_back(i < 8 ? slope.scene.cloth().capacity(i) / 2 : 0);
  slope.scene.cloth().setHeld(held);
  slope.scene.step(60);
  double wet = 0;
  double dry = 0;
  for (int i = 0; i < 8; ++i) {
    wet += double(slope.scene.node(i).m_x.x()) / 8;
    dry += double(slope.scene.node(i + 8).m_x.x()) / 8;
  }
  EXPECT_GT(dry - wet, 0.002) << "the dry half runs ahead";
}

TEST_IN_EVERY_WORLD(WetFrictionInWorld, AFloodedClothMaySlideBetterThanADryOne) {
  Slope dry(GetParam(), 1.2);
  Slope flooded(GetParam(), 1.2);
  flooded.scene.cloth().add<WetFriction>({2.5, 0.5, 0.2});
  flooded.scene.cloth().setSaturation(1);
  dry.scene.step(60);
  flooded.scene.step(60);
  EXPECT_GT(flooded.speed(), 1.05 * dry.speed());
}

// --- soft bodies ----------------------------------------------------------------------------------------------------

// Two sheets, one over the other: which coefficient the contacts have when Bullet solves them.
TEST(WetFrictionBetweenCloths, IsTheLargerOfTheTwo) {
  for (const WorldKind kind : {WorldKind::softRigid, WorldKind::softMultiBody}) {
    for (const bool both : {false, true}) {
      ClothScene scene(kind, kEarthGravity, Lying().builder(kind));
      RigidBody floor(scene.bullet(), box(1, 0.5, 1), 0, {0, -0.5, 0});
      Lying above;
      above.height = 0.05;
      const auto upper = above.builder(kind)(scene.bullet().info());
      scene.bullet().add(*upper);
      scene.body().m_cfg.kDF = btScalar(0.2);
      upper->m_cfg.kDF = btScalar(0.3);
      wetcloth::WetCloth& second = scene.wet().add(*upper);
      scene.cloth().add<WetFriction>();
      if (both) second.add<WetFriction>({2, 0.5, 2});
      scene.cloth().setSaturation(0.5);
      second.setSaturation(0.5);
      int found = 0;
      addCall(
          second,
          [&](wetcloth::WetCloth&, const wetcloth::Step&) {
            for (btSoftBody* body : {&scene.body(), upper.get()}) {
              for (int i = 0; i < body->m_scontacts.size(); ++i, ++found) {
                // 0.2 x 2.5 against 0.3, or against 0.3 x 2; rounded to btScalar.
                EXPECT_NEAR(double(body->m_scontacts[i].m_friction), both ? 0.6 : 0.5, 1e-6);
              }
            }
          },
          wetcloth::Stage::contact);
      scene.step(120);
      EXPECT_GT(found, 0);
      scene.wet().remove(*upper);
      scene.bullet().remove(*upper);
    }
  }
}

// --- bad input ------------------------------------------------------------------------------------------------------

TEST(WetFrictionParameters, AreChecked) {
  const double nan = std::nan("");
  const auto why = [](double wet, double peak, double flooded) {
    return rejection([&] { WetFriction({wet, peak, flooded}); });
  };
  EXPECT_EQ(why(-1, 0.5, 1), "WetFriction.wetFactor = -1: must be finite and >= 0");
  EXPECT_NE(why(nan, 0.5, 1), "");
  EXPECT_NE(why(HUGE_VAL, 0.5, 1), "");
  EXPECT_EQ(why(1, 0, 1), "WetFriction.peakSaturation = 0: must be in (0, 1]");
  EXPECT_NE(why(1, 1.5, 1), "");
  EXPECT_NE(why(1, nan, 1), "");
  EXPECT_EQ(why(1, 0.5, -2), "WetFriction.floodedFactor = -2: must be finite and >= 0");
  WetFriction friction({});
  EXPECT_THROW(friction.setParameters({-1, 0.5, 1}), std::invalid_argument);
  EXPECT_EQ(friction.parameters().wetFactor, 2.5);
}

TEST(WetFrictionOnABody, SaysWhyItCannotWork) {
  using Flags = btSoftBody::fCollision;
  const auto why = [](WorldKind kind, int flags) {
    ClothScene scene(kind, kEarthGravity, Lying().builder(kind));
    scene.body().m_cfg.collisions = flags;
    return rejection([&] { scene.cloth().add<WetFriction>(); });
  };
  EXPECT_NE(why(WorldKind::softRigid, Flags::CL_RS | Flags::CL_SS).find("clusters"), std::string::npos);
  EXPECT_NE(why(WorldKind::softRigid, 0).find("SDF_RS"), std::string::npos);
  EXPECT_EQ(why(WorldKind::softRigid, Flags::SDF_RS | Flags::CL_SS), "") << "one kind is enough";
  EXPECT_EQ(why(WorldKind::softRigid, Flags::VF_SS), "");
  EXPECT_NE(why(WorldKind::deformable, Flags::SDF_RD).find("SDF_RDN"), std::string::npos);
  EXPECT_NE(why(WorldKind::deformable, Flags::VF_DD).find("after its solve"), std::string::npos);
  EXPECT_EQ(why(WorldKind::deformable, Flags::SDF_RD | Flags::SDF_RDF), "");
}

}  // namespace
}  // namespace wetcloth_test::wet_friction_test
