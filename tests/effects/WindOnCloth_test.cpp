// SPDX-License-Identifier: Zlib
// What the wind does to a whole cloth in one step: total force, its sharing among corners, relative speed.

#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"
#include "tests/support/SoftBodies.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace wetcloth_test::wind_on_cloth_test {
namespace {

using wetcloth::ClothPatch;
using wetcloth::Fabric;
using wetcloth::Hook;
using wetcloth::Wind;
using Law = wetcloth::Wind::Law;

constexpr double kPi = 3.14159265358979323846;

Wind::Parameters wind(const btVector3& velocity, Law law = Law::quadratic) {
  Wind::Parameters parameters;
  parameters.velocity = velocity;
  parameters.law = law;
  return parameters;
}

/// The force of one substep of 1e-4 s on a cloth that is too heavy to move in it.
btVector3 forceOn(const ClothPatch& patch, const Wind::Parameters& parameters,
                  const std::function<void(btSoftBody&)>& prepare = {}) {
  ClothPatch heavy = patch;
  heavy.arealDensity = 1e4;
  ClothScene scene(WorldKind::softRigid, kNoGravity, heavy, Fabric::cotton(), Hook::manual);
  if (prepare) prepare(scene.body());
  Wind& effect = scene.cloth().add<Wind>(parameters);
  scene.preTick(1e-4);
  return effect.totalForce();
}

/// Bends a level patch of side 1 m about the z axis into half a cylinder that bulges towards +y.
void bendToHalfCylinder(btSoftBody& body) {
  const double radius = 1 / kPi;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    btSoftBody::Node& node = body.m_nodes[i];
    const double angle = double(node.m_x.x()) * kPi;  // -pi/2 .. pi/2
    node.m_x.setX(btScalar(radius * std::sin(angle)));
    node.m_x.setY(btScalar(radius * std::cos(angle)));
    node.m_q = node.m_x;
  }
}

// --- total force --------------------------------------------------------------------------------------------

// 1e-5: float32 sums 2 x 31 x 31 triangles, each rounded to 1e-7; the cloth's own motion in the step is 1e-8 m/s.
constexpr double kSum = 1e-5;

TEST(WindOnCloth, QuadraticForceOnAFlatSheetIsPressureTimesArea) {
  const btVector3 force = forceOn(levelPatch(32, 2), wind(btVector3(0, 5, 0)));
  const double expected = 0.5 * 1.225 * 1.2 * 4 * 25;
  EXPECT_NEAR(force.y() / expected, 1, kSum);
  EXPECT_NEAR(force.x(), 0, expected * kSum);
  EXPECT_NEAR(force.z(), 0, expected * kSum);
}

TEST(WindOnCloth, QuadraticForceUsesDensityAndCoefficient) {
  Wind::Parameters parameters = wind(btVector3(0, -2, 0));
  parameters.airDensity = 0.9;
  parameters.dragCoefficient = 0.7;
  const btVector3 force = forceOn(levelPatch(9, 1), parameters);
  EXPECT_NEAR(force.y() / (-0.5 * 0.9 * 0.7 * 4), 1, kSum);
}

TEST(WindOnCloth, LinearForceOnAFlatSheetIsCoefficientTimesAreaTimesSpeed) {
  Wind::Parameters parameters = wind(btVector3(0, 5, 0), Law::linear);
  parameters.linearDrag = 0.4;
  EXPECT_NEAR(forceOn(levelPatch(32, 2), parameters).y() / (0.4 * 4 * 5), 1, kSum);
}

TEST(WindOnCloth, ObliqueWindPushesAlongTheNormalByItsNormalSpeed) {
  const btVector3 force = forceOn(levelPatch(9, 1), wind(btVector3(3, 4, 0)));
  EXPECT_NEAR(force.y() / (0.5 * 1.225 * 1.2 * 16), 1, kSum);
  EXPECT_NEAR(force.x(), 0, 1e-5);
}

TEST(WindOnCloth, SkinFrictionDragsAlongTheSheet) {
  Wind::Parameters parameters = wind(btVector3(3, 0, 4));
  EXPECT_NEAR(forceOn(levelPatch(9, 2), parameters).length(), 0, 1e-4);
  parameters.skinFriction = 0.01;
  const btVector3 force = forceOn(levelPatch(9, 2), parameters);
  const double size = 0.5 * 1.225 * 0.01 * 4 * 25;
  EXPECT_NEAR(force.x() / (0.6 * size), 1, 1e-4);
  EXPECT_NEAR(force.z() / (0.8 * size), 1, 1e-4);
}

TEST(WindOnCloth, SameForceAt32And128AlsoWhenCurved) {
  for (Law law : {Law::quadratic, Law::linear}) {
    for (const btVector3& velocity : {btVector3(0, 5, 0), btVector3(2, -4, 1)}) {
      SCOPED_TRACE(velocity.x());
      const double flat32 = forceOn(levelPatch(32, 1), wind(velocity, law)).length();
      const double flat128 = forceOn(levelPatch(128, 1), wind(velocity, law)).length();
      EXPECT_NEAR(flat32 / flat128, 1, 1e-4);
      const double bent32 = forceOn(levelPatch(32, 1), wind(velocity, law), bendToHalfCylinder).length();
      const double bent128 = forceOn(levelPatch(128, 1), wind(velocity, law), bendToHalfCylinder).length();
      EXPECT_NEAR(bent32 / bent128, 1, 0.01);  // the polygon's error is (pi / 31)^2 / 12 = 0.1 %
    }
  }
}

TEST(WindOnCloth, ForceOnAHalfCylinderFollowsTheIntegral) {
  // Per length: 1/2 rho C_d u^2 R times the integral of cos^3 over half a turn, 4/3; linear: k u R pi / 2.
  const double radius = 1 / kPi;
  const btVector3 quadratic = forceOn(levelPatch(128, 1), wind(btVector3(0, -3, 0)), bendToHalfCylinder);
  EXPECT_NEAR(quadratic.y() / (-0.5 * 1.225 * 1.2 * 9 * radius * 4 / 3), 1, 1e-3);
  const btVector3 linear = forceOn(levelPatch(128, 1), wind(btVector3(0, -3, 0), Law::linear), bendToHalfCylinder);
  EXPECT_NEAR(linear.y() / (-0.256 * 3 * radius * kPi / 2), 1, 1e-3);
}

TEST(WindOnCloth, LightClothTakesTheSameMomentumAt32And128) {
  const auto gained = [](int n) {
    ClothScene scene(WorldKind::softRigid, kNoGravity, levelPatch(n, 1), Fabric::cotton(), Hook::manual);
    scene.cloth().add<Wind>(wind(btVector3(0, 5, 0)));
    for (int i = 0; i < 24; ++i) scene.preTick(kSubstep);
    return momentum(scene.body())[1];
  };
  EXPECT_NEAR(gained(32) / gained(128), 1, 1e-4);
}

// --- corners --------------------------------------------------------------------------------------------------

const std::vector<btVector3> kCorners = {btVector3(0, 0, 0), btVector3(2, 0, 0), btVector3(0, 2, 2)};
const std::vector<btScalar> kMasses = {1, 2, 5};

TEST(WindOnCloth, EachCornerTakesAThird) {
  for (Law law : {Law::quadratic, Law::linear}) {
    ClothScene scene(WorldKind::softRigid, kNoGravity, triangles(kCorners, kMasses, {{0, 1, 2}}), Fabric::cotton(),
                     Hook::manual);
    Wind::Parameters parameters = wind(btVector3(3, 4, 0), law);
    parameters.integration = Wind::Integration::explicitEuler;
    scene.cloth().add<Wind>(parameters);
    scene.preTick(0.125);
    const btVector3 force =
        law == Law::quadratic
            ? wetcloth::quadraticWindForce(kCorners[0], kCorners[1], kCorners[2], kNoGravity, btVector3(3, 4, 0),
                                           parameters.airDensity, parameters.dragCoefficient, 0)
            : wetcloth::linearWindForce(kCorners[0], kCorners[1], kCorners[2], kNoGravity, btVector3(3, 4, 0),
                                        parameters.linearDrag);
    for (int i = 0; i < 3; ++i) {
      const btVector3 expected = force * (btScalar(0.125) / 3 / kMasses[std::size_t(i)]);
      EXPECT_LE((scene.node(i).m_v - expected).length(), 1e-5 * expected.length()) << i;
    }
  }
}

TEST(WindOnCloth, InThePaperEachCornerTakesTheWholeForceOfEachTriangle) {
  std::vector<btVector3> corners = kCorners;
  corners.push_back(btVector3(2, 2, 2));  // with 2 and 1 a second triangle in the same plane
  ClothScene scene(WorldKind::softRigid, kNoGravity, triangles(corners, {1, 2, 5, 4}, {{0, 1, 2}, {2, 1, 3}}),
                   Fabric::cotton(), Hook::manual);
  Wind::Parameters parameters = wind(btVector3(3, 4, 0), Law::paper);
  parameters.paperForce = 0.5;
  Wind& effect = scene.cloth().add<Wind>(parameters);
  scene.preTick(0.125);
  const btVector3 force(0, 1, -1);  // half of n (n . wind) = (0, 2, -2)
  const btScalar facesPerMass[] = {1, 1, btScalar(2.0 / 5), btScalar(0.25)};
  for (int i = 0; i < 4; ++i) {
    const btVector3 expected = force * (btScalar(0.125) * facesPerMass[i]);
    EXPECT_LE((scene.node(i).m_v - expected).length(), 1e-5) << i;
  }
  EXPECT_LE((effect.totalForce() - btScalar(6) * force).length(), 1e-4);
}

TEST(WindOnCloth, InThePaperForceCountsTrianglesNotArea) {
  const auto force = [](int n, double side) {
    return double(forceOn(levelPatch(n, side), wind(btVector3(0, 1.5, 0), Law::paper)).y());
  };
  EXPECT_NEAR(force(9, 1) / (2 * 64 * 3 * 1.5e-3), 1, kSum);
  EXPECT_NEAR(force(9, 10) / force(9, 1), 1, kSum);
  EXPECT_NEAR(force(17, 1) / force(9, 1), 4, 4 * kSum);
}

TEST(WindOnCloth, InThePaperForceDoesNotKnowTheClothsMotion) {
  const auto moving = [](btSoftBody& body) { setVelocity(body, btVector3(0, 3, 0)); };
  const double still = forceOn(levelPatch(9, 1), wind(btVector3(0, 1, 0), Law::paper)).y();
  EXPECT_NEAR(forceOn(levelPatch(9, 1), wind(btVector3(0, 1, 0), Law::paper), moving).y(), still, still * kSum);
}

TEST(WindOnCloth, PinnedNodesDoNotMove) {
  ClothPatch patch = levelPatch(5, 1);
  patch.pinnedCorners = {ClothPatch::Corner::bottomLeft};
  for (Law law : {Law::quadratic, Law::linear, Law::paper}) {
    ClothScene scene(WorldKind::softRigid, kNoGravity, patch, Fabric::cotton(), Hook::manual);
    scene.cloth().add<Wind>(wind(btVector3(0, 5, 0), law));
    scene.preTick(kSubstep);
    EXPECT_EQ(scene.node(0).m_v, kNoGravity);
    EXPECT_GT(scene.node(1).m_v.y(), 0);
  }
}

// --- relative speed ---------------------------------------------------------------------------------------------

TEST(WindOnCloth, ClothThatMovesWithTheAirFeelsNothing) {
  const btVector3 velocity(3, 4, -1);
  for (Law law : {Law::quadratic, Law::linear}) {
    ClothScene scene(WorldKind::softRigid, kNoGravity, levelPatch(9, 1), Fabric::cotton(), Hook::manual);
    Wind::Parameters parameters = wind(velocity, law);
    parameters.skinFriction = 0.1;
    Wind& effect = scene.cloth().add<Wind>(parameters);
    setVelocity(scene.body(), velocity);
    scene.preTick(kSubstep);
    EXPECT_EQ(effect.totalForce(), kNoGravity);
    for (int i = 0; i < 81; ++i) EXPECT_EQ(scene.node(i).m_v, velocity);
  }
}

TEST(WindOnCloth, OnlyTheRelativeSpeedCounts) {
  const btVector3 drift(1, -3, 2);
  const auto moving = [&](btSoftBody& body) { setVelocity(body, drift); };
  for (Law law : {Law::quadratic, Law::linear}) {
    const btVector3 still = forceOn(levelPatch(9, 1), wind(btVector3(2, 5, 0), law));
    const btVector3 moved = forceOn(levelPatch(9, 1), wind(btVector3(2, 5, 0) + drift, law), moving);
    EXPECT_LE((still - moved).length(), kSum * still.length());
  }
}

}  // namespace
}  // namespace wetcloth_test::wind_on_cloth_test
