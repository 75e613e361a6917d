// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/HullPlanes.h"

#include "bullet_wetcloth/solver/ShapeDistance.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace wetcloth_test::hull_planes_test {
namespace {

using wetcloth::MeasuredShape;

// Of a cube as of a box, but for what is before an edge, where it is no farther than the box.
TEST(HullPlanes, OfACube) {
  wetcloth::HullPlanes planes;
  EXPECT_TRUE(planes.isEmpty());
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      std::array<double, 3> normal{0, 0, 0};
      normal[std::size_t(axis)] = side;
      planes.add(normal, 1);
    }
  }
  const MeasuredShape box(btBoxShape(btVector3(1, 1, 1)));
  for (const btVector3& point : {btVector3(3, 0, 0), btVector3(0, btScalar(-0.8), 0), btVector3(0.5, 0.25, -7)}) {
    EXPECT_NEAR(double(planes.distanceTo(point).distance), double(box.distanceTo(point).distance), 1e-6);
    EXPECT_LT(double((planes.distanceTo(point).normal - box.distanceTo(point).normal).length()), 1e-6);
  }
  EXPECT_NEAR(double(planes.distanceTo(btVector3(4, 5, 0)).distance), 4, 1e-6);  // the box is 5 m away
}

// Around a ball: a plane for each of many directions.
class HullPlanesAroundABall : public testing::Test {
 protected:
  HullPlanesAroundABall() {
    for (int k = 0; k < 53; ++k) {
      btVector3 n = random();
      n.normalize();
      m_normals.push_back(n);
      planes.add({double(n.x()), double(n.y()), double(n.z())}, offset);
    }
  }
  btVector3 random() {
    std::uniform_real_distribution<btScalar> number(-1, 1);
    const btScalar x = number(m_random);
    const btScalar y = number(m_random);
    return btVector3(x, y, number(m_random));
  }
  double distanceOf(const btVector3& point, std::size_t plane) const {
    return double(m_normals[plane].dot(point)) - offset;
  }
  double farthest(const btVector3& point) const {
    double most = -HUGE_VAL;
    for (std::size_t k = 0; k < m_normals.size(); ++k) most = std::max(most, distanceOf(point, k));
    return most;
  }

  static constexpr double offset = 0.4;
  // Of three products and sums of numbers below 1.
  static constexpr double kRounding = 1e-6;
  wetcloth::HullPlanes planes;

 private:
  std::vector<btVector3> m_normals;
  std::mt19937 m_random{5};
};

TEST_F(HullPlanesAroundABall, TheFarthestOneIsFound) {
  for (int k = 0; k < 200; ++k) {
    const btVector3 point = random();
    const std::size_t plane = planes.farthestFrom(point);
    ASSERT_LT(plane, 53u);
    EXPECT_NEAR(distanceOf(point, plane), farthest(point), kRounding);
  }
}

// The plane of the point before, whatever it was, is only a guess.
TEST_F(HullPlanesAroundABall, WhatIsLikelyChangesNothingBelowEnough) {
  std::size_t likely = 0;
  int near = 0;
  for (int k = 0; k < 1000; ++k) {
    const btVector3 point = random();
    const double found = double(planes.distanceTo(point, btScalar(0.1), likely).distance);
    if (farthest(point) > 0.1) {
      EXPECT_GT(found, 0.1);
      EXPECT_LE(found, farthest(point) + kRounding);
    } else {
      EXPECT_NEAR(found, farthest(point), kRounding);
      ++near;
    }
  }
  EXPECT_GT(near, 20);
}

}  // namespace
}  // namespace wetcloth_test::hull_planes_test
