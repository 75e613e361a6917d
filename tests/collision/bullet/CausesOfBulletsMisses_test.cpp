// SPDX-License-Identifier: Zlib
// One small example for each thing that makes Bullet 3.24's check of a node against a face miss a contact, and for what
// is odd about its parts. All of these pin what plain Bullet does: a failure means that Bullet changed, and that
// docs/ccd.md is to be updated.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "command/ccd/BulletCheck.h"
#include "tests/support/BulletWorld.h"

#include <BulletSoftBody/poly34.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <limits>

#if defined(__unix__) && GTEST_HAS_DEATH_TEST
#include <sys/time.h>
#endif

namespace wetcloth_test::causes_of_bullets_misses_test {
namespace {

using BulletsQuery = wetcloth::collision::Query<double>;

// A node that meets the triangle (0,0,0), (s,0,0), (0,s,0) half-way, well inside, as it falls at a slant in no special
// direction from s/2 above to s/2 below.
BulletsQuery slantedFall(double s) {
  return {{{0.2 * s, 0.25 * s, 0.5 * s}, {0, 0, 0}, {s, 0, 0}, {0, s, 0}},
          {{0.31 * s, 0.23 * s, -0.5 * s}, {0, 0, 0}, {s, 0, 0}, {0, s, 0}}};
}

bool separatedByBullet(const BulletsQuery& points) {
  const command::BulletQuery query(points);
  return hasSeparatingPlane(&query.face(), &query.node(), query.step());
}

TEST(CausesOfBulletsMisses, AnOrdinaryContactIsFound) {
  EXPECT_FALSE(separatedByBullet(slantedFall(1)));
  EXPECT_TRUE(command::bulletContinuousCheck(slantedFall(1)));
  EXPECT_TRUE(command::BulletQuery(slantedFall(1)).checkAsItsWorldDoes());
}

// hasSeparatingPlane ------------------------------------------------------------------------------------------------

TEST(CausesOfBulletsMisses, ANodeAtRestUnderAMovingFaceIsSeparated) {
  const BulletsQuery points = {{{0.2, 0.25, 0}, {0, 0, 0.5}, {1, 0, 0.5}, {0, 1, 0.5}},
                               {{0.2, 0.25, 0}, {0, 0, -0.5}, {1, 0, -0.5}, {0, 1, -0.5}}};
  EXPECT_TRUE(separatedByBullet(points)) << "Bullet's hasSeparatingPlane changed: update docs/ccd.md";
  EXPECT_FALSE(command::bulletContinuousCheck(points)) << "Bullet's hasSeparatingPlane changed: update docs/ccd.md";
  EXPECT_FALSE(command::BulletQuery(points).checkAsItsWorldDoes());
}

TEST(CausesOfBulletsMisses, ANodeThatFallsStraightDownIsSeparated) {
  for (const double size : {0.1, 1.0, 100.0}) {
    BulletsQuery points = slantedFall(size);
    points.end[0][0] = points.start[0][0];
    points.end[0][1] = points.start[0][1];
    EXPECT_TRUE(separatedByBullet(points)) << "Bullet's hasSeparatingPlane changed: update docs/ccd.md";
    EXPECT_FALSE(command::bulletContinuousCheck(points)) << size;
  }
}

// It compares with SIMD_EPSILON, a length: motion below it counts as none.
TEST(CausesOfBulletsMisses, SeparationDependsOnTheUnitOfLength) {
  const double tiny = 0.5 * double(SIMD_EPSILON);
  BulletsQuery points = slantedFall(1);
  points.end[0][0] = points.start[0][0] + tiny;
  EXPECT_TRUE(separatedByBullet(points)) << "Bullet's hasSeparatingPlane changed: update docs/ccd.md";
  points.end[0][0] = points.start[0][0] + 1e4 * tiny;
  EXPECT_FALSE(separatedByBullet(points));
}

// SolveP3 -----------------------------------------------------------------------------------------------------------

TEST(CausesOfBulletsMisses, SolveP3TakesANegativeQForATinyPositiveOne) {
  // x^3 + 3 x - 1.625 has the root 1/2; with q ~ 0 the answer is that of x^3 = 1.625.
  btScalar x[3];
  EXPECT_EQ(SolveP3(x, 0, 3, btScalar(-1.625)), 1);
  // Exact to a few roundings of btScalar.
  EXPECT_NEAR(double(x[0]), std::cbrt(1.625), 1e-5) << "Bullet's SolveP3 changed: update docs/ccd.md";
}

// A triangle that turns and grows about its corner while the node falls through: f = (1 + t^2) (1/2 - t), so
// a^2 = 1/4 < 3 b = 3.
TEST(CausesOfBulletsMisses, ANegativeQMissesATurningFace) {
  const BulletsQuery points = {{{0.11, 0.45, 0.5}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                               {{0.22, 0.57, -0.5}, {0, 0, 0}, {1, 1, 0}, {-1, 1, 0}}};
  EXPECT_FALSE(separatedByBullet(points));
  EXPECT_FALSE(command::bulletContinuousCheck(points)) << "Bullet's SolveP3 changed: update docs/ccd.md";
  // The same face turning the less is no cubic any more, or one with a^2 > 3 b: found.
  BulletsQuery still = points;
  for (int i = 1; i < 4; ++i)
    for (int axis = 0; axis < 3; ++axis) still.end[i][axis] = still.start[i][axis];
  EXPECT_TRUE(command::bulletContinuousCheck(still));
}

// The cubic of a motion that is nearly linear has a huge second coefficient once it is monic, and the root is the
// difference of two numbers of that size.
TEST(CausesOfBulletsMisses, SolveP3LosesTheDigitsOfANearlyLinearMotion) {
  // (x - 1/2) (x + 2000) (x + 3000)
  btScalar x[3];
  ASSERT_EQ(SolveP3(x, btScalar(4999.5), btScalar(6e6 - 2500), btScalar(-3e6)), 3);
  double nearest = 1;
  for (const btScalar root : x) nearest = std::min(nearest, std::fabs(double(root) - 0.5));
    // Bullet's margin is 1e-6 of a length: at 1 m per step, the root has to be as exact as that.
#ifdef BT_USE_DOUBLE_PRECISION
  EXPECT_LT(nearest, 1e-6);
#else
  EXPECT_GT(nearest, 1e-5) << "Bullet's SolveP3 changed: update docs/ccd.md";
#endif
}

#if defined(__unix__) && GTEST_HAS_DEATH_TEST
// Its cube root divides by 8 until the number is below 8, which infinity never is: r^2 has overflowed.
TEST(CausesOfBulletsMissesDeathTest, SolveP3NeverReturnsWhenRSquaredOverflows) {
  const auto solve = [] {
    itimerval limit{};
    limit.it_value.tv_usec = 50000;  // ten thousand times what SolveP3 takes otherwise
    setitimer(ITIMER_VIRTUAL, &limit, nullptr);
    btScalar x[3];
    SolveP3(x, 0, 0, 100 * std::sqrt(std::numeric_limits<btScalar>::max()));
    std::_Exit(0);
  };
  EXPECT_EXIT(solve(), testing::KilledBySignal(SIGVTALRM), "") << "Bullet's SolveP3 changed: update docs/ccd.md";
}
#endif

// Thresholds --------------------------------------------------------------------------------------------------------

// proximityTest compares the square of twice the face's area [m^4] with SIMD_EPSILON: a right-angled face with legs
// below its fourth root, 18.6 mm in float32 and 0.12 mm in float64, meets nothing, whatever moves and however long it
// takes.
TEST(CausesOfBulletsMisses, FacesBelowACertainSizeMeetNothing) {
  const double smallest = std::pow(double(SIMD_EPSILON), 0.25);
  for (const double step : {1.0, 1.0 / 60, 1.0 / 240}) {
    EXPECT_FALSE(command::bulletContinuousCheck(slantedFall(0.99 * smallest), step))
        << "Bullet's proximityTest changed: update docs/ccd.md";
    EXPECT_FALSE(command::bulletContinuousCheck(slantedFall(0.5 * smallest), step));
  }
  EXPECT_TRUE(command::bulletContinuousCheck(slantedFall(1.01 * smallest), 1.0 / 60));
}

TEST(CausesOfBulletsMisses, AbsoluteThresholdsMissSmallClothInFloat32) {
  const double size = 0.01;  // a fine cloth's edges, in metres
#ifdef BT_USE_DOUBLE_PRECISION
  EXPECT_TRUE(command::bulletContinuousCheck(slantedFall(size), 1.0 / 60));
#else
  EXPECT_FALSE(command::bulletContinuousCheck(slantedFall(size), 1.0 / 60))
      << "Bullet's thresholds changed: update docs/ccd.md";
#endif
  // The same, in centimetres.
  EXPECT_TRUE(command::bulletContinuousCheck(slantedFall(100 * size), 1.0 / 60));
}

#ifndef BT_USE_DOUBLE_PRECISION
// The coefficients have the unit m^3 / s^k and one threshold: 2 cm in one step of 1 s is no motion, in 1/60 s it is.
TEST(CausesOfBulletsMisses, ThresholdsDependOnTheUnitOfTime) {
  EXPECT_FALSE(command::bulletContinuousCheck(slantedFall(0.02), 1))
      << "Bullet's continuousCollisionDetection changed: update docs/ccd.md";
  EXPECT_TRUE(command::bulletContinuousCheck(slantedFall(0.02), 1.0 / 60));
}
#endif

// Times -------------------------------------------------------------------------------------------------------------

TEST(CausesOfBulletsMisses, AContactAtTheVeryStartIsSkipped) {
  BulletsQuery points = slantedFall(1);
  points.start[0][2] = 0;  // it starts on the face
  EXPECT_FALSE(command::bulletContinuousCheck(points))
      << "Bullet's continuousCollisionDetection changed: update docs/ccd.md";
}

// Where all is in one plane all along, Bullet looks at the end of the step alone.
TEST(CausesOfBulletsMisses, ANodeThatCrossesAFaceInItsOwnPlaneIsMissed) {
  BulletsQuery points = {{{-1, 0.26, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                         {{2, 0.35, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  EXPECT_FALSE(separatedByBullet(points));
  EXPECT_FALSE(command::bulletContinuousCheck(points))
      << "Bullet's continuousCollisionDetection changed: update docs/ccd.md";
  points.end[0][0] = 0.3;  // ends inside the face
  EXPECT_TRUE(command::bulletContinuousCheck(points));
}

// Margins -----------------------------------------------------------------------------------------------------------

TEST(CausesOfBulletsMisses, WhatPassesAFaceWithinTheMarginIsAFalseAlarm) {
  BulletsQuery points = slantedFall(1);
  const auto passBeside = [&](double gap) {
    points.start[0][1] = -gap - 0.1;
    points.end[0][1] = -gap + 0.1;  // at half-time, when it is in the plane, -gap from the edge on the x axis
    return command::bulletContinuousCheck(points);
  };
  // The margin in weights is 1e-6 / sqrt(area) = 1.4e-6; half of it, and ten times it.
  EXPECT_TRUE(passBeside(0.7e-6)) << "Bullet's proximityTest changed: update docs/ccd.md";
  EXPECT_FALSE(passBeside(1.4e-5));
}

// bernsteinVFTest ---------------------------------------------------------------------------------------------------

TEST(CausesOfBulletsMisses, BernsteinVFTestReturnsBeforeItsInsideTest) {
  BulletsQuery points = slantedFall(1);
  points.start[0][0] += 50;
  points.end[0][0] += 50;  // through the plane, far from the face
  const command::BulletQuery query(points);
  EXPECT_TRUE(bernsteinVFTest(&query.face(), &query.node(), query.step(), SAFE_EPSILON))
      << "Bullet's bernsteinVFTest changed: update docs/ccd.md";
  btScalar k0, k1, k2, k3;
  getBernsteinCoeff(&query.face(), &query.node(), query.step(), k0, k1, k2, k3);
  EXPECT_FALSE(coplanarAndInsideTest(k0, k1, k2, k3, &query.face(), &query.node(), query.step()));
  EXPECT_FALSE(query.checkAsItsWorldDoes());
}

// In its world ------------------------------------------------------------------------------------------------------

struct BulletsMeeting {
  int contacts;      // that the continuous check of Bullet's world has found
  double speedLeft;  // of the upper body, as a share
};

// Two bodies of one face each in the deformable world, without gravity; the upper one falls by 0.9 m in one step.
BulletsMeeting meetInBulletsWorld(const btVector3 (&lower)[3], const btVector3 (&upper)[3]) {
  BulletWorld bullet(WorldKind::deformable, btVector3(0, 0, 0));
  const btScalar masses[3] = {1, 1, 1};
  btSoftBody a(&bullet.info(), 3, lower, masses), b(&bullet.info(), 3, upper, masses);
  for (btSoftBody* body : {&a, &b}) {
    body->appendFace(0, 1, 2);
    // Bullet pairs neighbours for its trees, and never ends where nodes have no links.
    for (int i = 0; i < 3; ++i) body->appendLink(i, (i + 1) % 3);
    // Without SDF_RD there is no tree of faces, and no contact.
    body->m_cfg.collisions = btSoftBody::fCollision::SDF_RD | btSoftBody::fCollision::VF_DD;
    body->getCollisionShape()->setMargin(btScalar(0.001));
    bullet.add(*body);
  }
  const btScalar dt = btScalar(1) / 60;
  const btVector3 velocity(btScalar(0.07) / dt, btScalar(0.03) / dt, btScalar(-0.9) / dt);
  b.setVelocity(velocity);
  bullet.step(1, dt);
  const btVector3 left = (b.m_nodes[0].m_v + b.m_nodes[1].m_v + b.m_nodes[2].m_v) / 3;
  const BulletsMeeting meeting = {a.m_faceNodeContactsCCD.size() + b.m_faceNodeContactsCCD.size(),
                                  double(left.length() / velocity.length())};
  bullet.remove(a);
  bullet.remove(b);
  return meeting;
}

// An upright triangle with a level edge on top, and one across it with a level edge below: the edges pass through each
// other, and no node comes near a face.
TEST(CausesOfBulletsMisses, ThereIsNoEdgeEdgeCheckForSoftBodies) {
  const btVector3 lower[3] = {btVector3(-1, 0, 0), btVector3(1, 0, 0), btVector3(0, 0, btScalar(-1.5))};
  const btVector3 edgeDown[3] = {btVector3(0, -1, btScalar(0.5)), btVector3(0, 1, btScalar(0.5)), btVector3(0, 0, 2)};
  const BulletsMeeting meeting = meetInBulletsWorld(lower, edgeDown);
  EXPECT_EQ(meeting.contacts, 0) << "Bullet checks edges of soft bodies against each other: update docs/ccd.md";
  EXPECT_NEAR(meeting.speedLeft, 1, 1e-5);  // a few roundings of btScalar
}

// The same fall onto a level triangle, corner first: it does find that. But its world keeps such contacts in a list of
// their own, m_faceNodeContactsCCD, of which only the length is ever read.
TEST(CausesOfBulletsMisses, TheContactsThatItsWorldFindsMoveNothing) {
  const btVector3 level[3] = {btVector3(-2, -1, 0), btVector3(2, -1, 0), btVector3(0, 2, 0)};
  const btVector3 cornerDown[3] = {btVector3(0, -1, 2), btVector3(0, 1, 2), btVector3(0, 0, btScalar(0.5))};
  const BulletsMeeting meeting = meetInBulletsWorld(level, cornerDown);
  EXPECT_EQ(meeting.contacts, 1);
  EXPECT_NEAR(meeting.speedLeft, 1, 1e-5)  // a few roundings of btScalar
      << "Bullet's world answers to the contacts of its continuous check: update docs/ccd.md";
}

}  // namespace
}  // namespace wetcloth_test::causes_of_bullets_misses_test
