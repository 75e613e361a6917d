// SPDX-License-Identifier: Zlib
// Where bodies are between the times that a scene tells, and how fast they get there.

#include "command/scene/RigidMotion.h"
#include "command/scene/Collider.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wetcloth_test::rigid_motion_test {
namespace {

using command::RigidMotion;

constexpr double kRounding = 1e-5;

btQuaternion aboutY(double degrees) { return btQuaternion(btVector3(0, 1, 0), btScalar(degrees * SIMD_PI / 180)); }

void expectAt(const btVector3& found, double x, double y, double z) {
  EXPECT_NEAR((found - btVector3(btScalar(x), btScalar(y), btScalar(z))).length(), 0, kRounding);
}

/// A quarter turn about (1, 0, 0) in 2 s.
RigidMotion quarterTurn() {
  const btVector3 pivot(1, 0, 0);
  return {pivot, {0, 2}, {pivot, pivot}, {aboutY(0), aboutY(90)}};
}

TEST(RigidMotion, TurnsSteadilyAboutItsPivot) {
  const RigidMotion motion = quarterTurn();
  expectAt(motion.at(0) * btVector3(2, 0, 0), 2, 0, 0);
  const double half = std::sqrt(0.5);
  expectAt(motion.at(1) * btVector3(2, 0, 0), 1 + half, 0, -half);
  expectAt(motion.at(2) * btVector3(2, 0, 0), 1, 0, -1);
  expectAt(motion.at(1) * btVector3(1, 0, 0), 1, 0, 0);
}

TEST(RigidMotion, StaysBeforeAndAfter) {
  const RigidMotion motion = quarterTurn();
  expectAt(motion.at(-5) * btVector3(2, 0, 0), 2, 0, 0);
  expectAt(motion.at(100) * btVector3(2, 0, 0), 1, 0, -1);
}

TEST(RigidMotion, GoesStraightBetweenItsPlaces) {
  RigidMotion motion = quarterTurn();
  motion.places = {btVector3(1, 0, 0), btVector3(1, 4, 0)};
  expectAt(motion.at(0.5) * btVector3(1, 0, 0), 1, 1, 0);
}

TEST(RigidMotion, TheOuterOfTwoMovesTheWholeOfTheInnerOne) {
  RigidMotion outer{btVector3(0, 0, 0), {0, 4}, {btVector3(0, 0, 0), btVector3(0, 0, 8)}, {aboutY(0), aboutY(0)}};
  const RigidMotion both = chained(quarterTurn(), outer);
  for (const double time : {0.0, 2.0, 4.0}) {
    const btVector3 point(2, 3, 1);
    const btVector3 expected = outer.at(time) * (quarterTurn().at(time) * point);
    EXPECT_NEAR((both.at(time) * point - expected).length(), 0, kRounding) << time;
  }
}

// The rim of a wheel of radius r goes at r w, beside what its middle does.
TEST(RigidMotion, IsAsFastAsItsRim) {
  EXPECT_NEAR(quarterTurn().fastest(3), 3 * SIMD_PI / 4, kRounding);
  command::Collider ball(command::Sphere{btVector3(1, 0, 0), 0.5});
  EXPECT_EQ(fastestOf(ball), 0);
  ball.motion = quarterTurn();
  EXPECT_NEAR(fastestOf(ball), 0.5 * SIMD_PI / 4, kRounding);
}

}  // namespace
}  // namespace wetcloth_test::rigid_motion_test
