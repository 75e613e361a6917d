// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/ShapeFaces.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/solver/HullCrossing.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btEmptyShape.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletCollision/CollisionShapes/btTriangleMesh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

namespace wetcloth_test::shape_faces_test {
namespace {

using wetcloth::BodyBox;
using wetcloth::BodyPoint;
using wetcloth::ConvexHulls;
using wetcloth::HullCrossing;
using wetcloth::ShapeFaces;
using wetcloth::toSize;

BodyBox boxAround(double x, double y, double z, double half) {
  return {{x - half, y - half, z - half}, {x + half, y + half, z + half}};
}

ShapeFaces facesOf(const btCollisionShape& shape, const BodyBox& near, ConvexHulls& hulls) {
  ShapeFaces faces;
  faces.find(shape, {near}, near, hulls);
  return faces;
}

BodyPoint minus(const BodyPoint& a, const BodyPoint& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double triple(const BodyPoint& a, const BodyPoint& b, const BodyPoint& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// All that the faces enclose, seen from a point inside [m^3].
double volumeOf(const ShapeFaces& faces, const BodyPoint& inside) {
  double sum = 0;
  for (const ShapeFaces::Face& face : faces.faces()) {
    sum += std::fabs(triple(minus(faces.corners()[toSize(face.corner[0])], inside),
                            minus(faces.corners()[toSize(face.corner[1])], inside),
                            minus(faces.corners()[toSize(face.corner[2])], inside))) /
           6;
  }
  return sum;
}

/// Each side belongs to two faces, and both say the same of it.
void expectClosed(const ShapeFaces& faces) {
  std::map<std::pair<int, int>, std::vector<bool>> sides;
  for (const ShapeFaces::Face& face : faces.faces()) {
    for (std::size_t k = 0; k < 3; ++k) {
      sides[std::minmax(face.corner[k], face.corner[(k + 1) % 3])].push_back(face.isEdge[k]);
    }
  }
  for (const auto& side : sides) {
    ASSERT_EQ(side.second.size(), 2u);
    EXPECT_EQ(side.second[0], side.second[1]);
  }
}

struct Shape {
  const char* name;
  std::function<std::unique_ptr<btCollisionShape>()> make;
  double volume;
  double share;  // of it that the faces enclose, at least
};

const double kPi = 3.14159265358979;

std::vector<Shape> shapes() {
  const auto scalar = [](double x) { return btScalar(x); };
  return {
      {"box", [=] { return std::make_unique<btBoxShape>(btVector3(scalar(0.1), scalar(0.2), scalar(0.3))); },
       8 * 0.1 * 0.2 * 0.3, 0.999999},
      {"sphere", [=] { return std::make_unique<btSphereShape>(scalar(0.2)); }, 4 * kPi / 3 * 0.008, 0.85},
      {"capsule", [=] { return std::make_unique<btCapsuleShape>(scalar(0.1), scalar(0.3)); },
       kPi * 0.01 * (0.3 + 0.4 / 3), 0.85},
      {"cylinder", [=] { return std::make_unique<btCylinderShapeZ>(btVector3(scalar(0.1), scalar(0.1), scalar(0.3))); },
       kPi * 0.01 * 0.6, 0.98},
      {"cone", [=] { return std::make_unique<btConeShapeX>(scalar(0.1), scalar(0.3)); }, kPi * 0.01 * 0.1, 0.98},
      {"hull",
       [=] {
         auto hull = std::make_unique<btConvexHullShape>();
         for (const btVector3& point : {btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 1, 0), btVector3(0, 0, 1),
                                        btVector3(scalar(0.1), scalar(0.1), scalar(0.1))}) {
           hull->addPoint(point * scalar(0.3));
         }
         return hull;
       },
       0.027 / 6, 0.999999}};
}

TEST(ShapeFaces, ConvexShapesAreClosedAndNoLargerThanTheyAre) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    ConvexHulls hulls;
    const auto made = shape.make();
    const ShapeFaces faces = facesOf(*made, boxAround(0, 0, 0, 2), hulls);
    expectClosed(faces);
    const double volume = volumeOf(faces, {0.02, 0.02, 0.02});
    EXPECT_LE(volume, shape.volume * 1.000001);
    EXPECT_GE(volume, shape.volume * shape.share);
    ASSERT_EQ(faces.hulls().size(), 1u);
  }
}

TEST(ShapeFaces, DiagonalsOfABoxAreNoEdges) {
  ConvexHulls hulls;
  const btBoxShape box(btVector3(1, 1, 1));
  const ShapeFaces faces = facesOf(box, boxAround(0, 0, 0, 3), hulls);
  int edges = 0;
  for (const ShapeFaces::Face& face : faces.faces()) {
    for (const bool isEdge : face.isEdge) edges += isEdge ? 1 : 0;
  }
  EXPECT_EQ(faces.faces().size(), 12u);
  EXPECT_EQ(edges, 24) << "twelve, each of two faces";
}

// A floor of a kilometre is cut around the cloth: a corner 500 m away would be rounded to 0.03 mm.
TEST(ShapeFaces, WhatReachesFarIsCut) {
  ConvexHulls hulls;
  const btBoxShape box(btVector3(500, 1, 500));
  const ShapeFaces faces = facesOf(box, boxAround(100, 1, 20, 0.5), hulls);
  EXPECT_FALSE(faces.faces().empty());
  const BodyBox around = boxAround(100, 1, 20, 3);
  for (const BodyPoint& corner : faces.corners()) {
    EXPECT_TRUE(around.contains({corner, corner}));
    EXPECT_DOUBLE_EQ(corner[1], 1);
  }
  for (const ShapeFaces::Face& face : faces.faces()) {
    for (const bool isEdge : face.isEdge) EXPECT_FALSE(isEdge);
  }
}

TEST(ShapeFaces, APlaneCoversWhatIsNear) {
  ConvexHulls hulls;
  const btStaticPlaneShape plane(btVector3(0, 1, 0), btScalar(0.25));
  const ShapeFaces faces = facesOf(plane, boxAround(1000, 0, 1000, 1), hulls);
  BodyBox box;
  for (const BodyPoint& corner : faces.corners()) {
    box.include(corner);
    EXPECT_DOUBLE_EQ(corner[1], 0.25);
  }
  EXPECT_EQ(faces.faces().size(), 2u);
  EXPECT_TRUE(box.contains({{999, 0.25, 999}, {1001, 0.25, 1001}}));
}

// n x n squares of 1 m, two triangles each.
std::unique_ptr<btTriangleMesh> squares(int n) {
  auto mesh = std::make_unique<btTriangleMesh>();
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      const btVector3 corner(btScalar(i), 0, btScalar(k));
      mesh->addTriangle(corner, corner + btVector3(1, 0, 0), corner + btVector3(1, 0, 1));
      mesh->addTriangle(corner, corner + btVector3(1, 0, 1), corner + btVector3(0, 0, 1));
    }
  }
  return mesh;
}

TEST(ShapeFaces, OfAMeshThereIsOnlyWhatIsNear) {
  ConvexHulls hulls;
  const auto mesh = squares(60);
  const btBvhTriangleMeshShape shape(mesh.get(), true);
  const ShapeFaces faces = facesOf(shape, boxAround(30.5, 0, 20.5, 0.4), hulls);
  EXPECT_EQ(faces.faces().size(), 2u);
  EXPECT_EQ(faces.corners().size(), 4u) << "both have two corners in common";
  EXPECT_TRUE(facesOf(shape, boxAround(30.5, 5, 20.5, 0.4), hulls).faces().empty());
}

TEST(ShapeFaces, WhatTwoBoxesFindIsThereOnce) {
  ConvexHulls hulls;
  const auto mesh = squares(4);
  const btBvhTriangleMeshShape shape(mesh.get(), true);
  ShapeFaces faces;
  const BodyBox near = boxAround(1.5, 0, 1.5, 0.4);
  faces.find(shape, {near, near}, near, hulls);
  EXPECT_EQ(faces.faces().size(), 2u);
}

TEST(ShapeFaces, TerrainAndCompounds) {
  ConvexHulls hulls;
  const std::vector<btScalar> heights(25, btScalar(0.5));
  constexpr PHY_ScalarType kHeights = sizeof(btScalar) == sizeof(float) ? PHY_FLOAT : PHY_DOUBLE;
  const btHeightfieldTerrainShape terrain(5, 5, heights.data(), btScalar(1), btScalar(0), btScalar(1), 1, kHeights,
                                          false);
  EXPECT_FALSE(facesOf(terrain, boxAround(0.5, 0, 0.5, 0.3), hulls).faces().empty());
  btBoxShape box(btVector3(1, 1, 1));
  btCompoundShape compound;
  for (const int x : {-10, 10}) {
    compound.addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(x), 0, 0)), &box);
  }
  EXPECT_EQ(facesOf(compound, boxAround(10, 0, 0, 2), hulls).faces().size(), 12u);
  EXPECT_EQ(facesOf(compound, boxAround(0, 0, 0, 20), hulls).faces().size(), 24u);
  const btEmptyShape empty;
  EXPECT_TRUE(facesOf(empty, boxAround(0, 0, 0, 20), hulls).faces().empty());
}

TEST(ShapeFaces, RefinedFacesEncloseTheSame) {
  ConvexHulls hulls;
  const btBoxShape box(btVector3(btScalar(0.1), btScalar(0.2), btScalar(0.3)));
  ShapeFaces faces = facesOf(box, boxAround(0, 0, 0, 2), hulls);
  faces.refine(0.08);
  EXPECT_NEAR(volumeOf(faces, {0, 0, 0}), 8 * 0.1 * 0.2 * 0.3, 1e-7);
  for (const ShapeFaces::Face& face : faces.faces()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const BodyPoint side =
          minus(faces.corners()[toSize(face.corner[k])], faces.corners()[toSize(face.corner[(k + 1) % 3])]);
      EXPECT_LE(side[0] * side[0] + side[1] * side[1] + side[2] * side[2], 0.0064001);
    }
  }
}

// Points in one plane have faces on both sides of it and nothing inside; fewer have no faces.
TEST(ShapeFaces, HullsOfFewPoints) {
  const std::vector<btVector3> points = {btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(1, 1, 0),
                                         btVector3(0, 1, 0)};
  for (std::size_t count = 0; count <= points.size(); ++count) {
    SCOPED_TRACE(count);
    ConvexHulls hulls;
    btConvexHullShape shape;
    for (std::size_t k = 0; k < count; ++k) shape.addPoint(points[k]);
    const ShapeFaces faces = facesOf(shape, boxAround(0, 0, 0, 5), hulls);
    EXPECT_EQ(faces.faces().empty(), count < 3);
    for (const ShapeFaces::Hull& hull : faces.hulls()) {
      HullCrossing crossing;
      crossing.begin(*hull.hull, 1e-6);
      EXPECT_FALSE(crossing.isIn({{{0.5, 0.5, -1}, {0.6, 0.5, 1}, {0.5, 0.6, 1}}}));
    }
  }
}

// A shape may change between two steps, and another may be made where it was.
TEST(ConvexHulls, AreToldByWhatTheyAreMadeOf) {
  ConvexHulls hulls;
  btBoxShape box(btVector3(1, 1, 1));
  const wetcloth::ConvexHull* const first = &hulls.of(box);
  EXPECT_EQ(&hulls.of(box), first);
  box.setLocalScaling(btVector3(2, 1, 1));
  EXPECT_NEAR(hulls.of(box).box.high[0], 2, 1e-6);
  box.setLocalScaling(btVector3(1, 1, 1));
  EXPECT_EQ(&hulls.of(box), first);
}

TEST(HullCrossing, OfTrianglesAndABox) {
  ConvexHulls hulls;
  const btBoxShape box(btVector3(1, 1, 1));
  HullCrossing crossing;
  crossing.begin(hulls.of(box), 1e-6);
  EXPECT_TRUE(crossing.isIn({{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}})) << "all of it";
  EXPECT_TRUE(crossing.isIn({{{0, 0, 0}, {5, 0, 0}, {0, 5, 0}}})) << "a corner of it";
  EXPECT_TRUE(crossing.isIn({{{-5, -5, 0}, {5, -5, 0.1}, {0, 9, 0}}})) << "the box goes through it";
  EXPECT_FALSE(crossing.isIn({{{-5, -5, 1}, {5, -5, 1}, {0, 9, 1}}})) << "it lies on it";
  EXPECT_FALSE(crossing.isIn({{{1.9, 0.2, 0}, {0.2, 1.9, 0}, {3, 3, 0}}})) << "beside an edge, beyond no plane";
  EXPECT_FALSE(crossing.isIn({{{1.5, 0, 0}, {2.5, 0, 0}, {2, 1, 0}}}));
}

}  // namespace
}  // namespace wetcloth_test::shape_faces_test
