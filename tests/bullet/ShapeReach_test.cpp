// SPDX-License-Identifier: Zlib
// Whether a point is on a shape: every kind of shape against distances that are known.

#include "bullet_wetcloth/bullet/ShapeReach.h"
#include "tests/support/Bodies.h"

#include <gtest/gtest.h>

namespace wetcloth_test::shape_reach_test {
namespace {

using wetcloth::isWithinReach;

constexpr btScalar kReach = btScalar(0.03);
constexpr btScalar kSlack = btScalar(0.001);  // of GJK in float32

bool reaches(const btCollisionShape& shape, double x, double y, double z) {
  return isWithinReach(shape, btVector3(btScalar(x), btScalar(y), btScalar(z)), kReach);
}

TEST(ShapeReach, EndsAtItsDistanceOverTheTopOfEveryShape) {
  for (const BodyShape kind : kBodyShapes) {
    const OwnedShape made = makeShape(kind);
    EXPECT_TRUE(reaches(*made.shape, 0, made.top + double(kReach - kSlack), 0)) << nameOf(kind);
    EXPECT_TRUE(reaches(*made.shape, 0, made.top - 0.001, 0)) << nameOf(kind);
    EXPECT_FALSE(reaches(*made.shape, 0, made.top + double(kReach + kSlack), 0)) << nameOf(kind);
    EXPECT_FALSE(reaches(*made.shape, 0, made.top + 5, 0)) << nameOf(kind);
  }
}

TEST(ShapeReach, EndsAtAnEdge) {
  const OwnedShape wall = makeShape(BodyShape::box);
  EXPECT_TRUE(reaches(*wall.shape, 1.0, 0.51, 0));
  EXPECT_FALSE(reaches(*wall.shape, 1.04, 0.51, 0));
  const OwnedShape mesh = meshSquare(20);
  EXPECT_TRUE(reaches(*mesh.shape, 1.0, 0.1, 0));
  EXPECT_FALSE(reaches(*mesh.shape, 1.08, 0.1, 0));
  const OwnedShape boxes = overlappingBoxes(4);
  EXPECT_TRUE(reaches(*boxes.shape, 1.03, 0.51, 0));
  EXPECT_FALSE(reaches(*boxes.shape, 1.07, 0.51, 0));
}

TEST(ShapeReach, SeesAShapeThatWasScaled) {
  OwnedShape made = makeShape(BodyShape::box);
  made.shape->setLocalScaling(btVector3(2, 2, 2));
  EXPECT_TRUE(reaches(*made.shape, 0, 1.01, 0));
  made.shape->setLocalScaling(btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5)));
  EXPECT_FALSE(reaches(*made.shape, 0, 0.5, 0));
}

}  // namespace
}  // namespace wetcloth_test::shape_reach_test
