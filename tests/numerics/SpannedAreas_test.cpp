// SPDX-License-Identifier: Zlib
// The area that a node's triangles span, of cloth whose shape is known, whichever way round a mesh has them.

#include "bullet_wetcloth/numerics/SpannedAreas.h"

#include "bullet_wetcloth/mesh/RestMesh.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace wetcloth_test::spanned_areas_test {
namespace {

using wetcloth::RestMesh;
using wetcloth::SpannedAreas;

/// A level cloth of 5 x 5 nodes, put in another shape.
struct Cloth {
  explicit Cloth(const std::function<btVector3(const btVector3&)>& place)
      : scene(WorldKind::softRigid, levelPatch(5, 1)), body(scene.body()), mesh(body) {
    for (int i = 0; i < body.m_nodes.size(); ++i) body.m_nodes[i].m_x = place(body.m_nodes[i].m_x);
  }
  double share(int node) {
    areas.measure(mesh, body);
    return areas.share(std::size_t(node));
  }
  BodyScene scene;
  btSoftBody& body;
  RestMesh mesh;
  SpannedAreas areas;
};

TEST(SpannedAreas, AreTheDeterminantOfAFlatMap) {
  Cloth cloth([](const btVector3& x) {  // determinant 0.5 * 0.8
    return btVector3(btScalar(0.5) * x.x() + btScalar(0.3) * x.z(), 7, btScalar(0.8) * x.z());
  });
  for (int i = 0; i < 25; ++i) EXPECT_NEAR(cloth.share(i), 0.4, 1e-5) << i;
}

TEST(SpannedAreas, AreNoMoreThanAtRest) {
  Cloth cloth([](const btVector3& x) { return btVector3(2 * x.x(), x.y(), x.z()); });
  for (int i = 0; i < 25; ++i) EXPECT_EQ(cloth.share(i), 1) << i;
}

TEST(SpannedAreas, StayThoseAtRestHoweverTheClothIsTurned) {
  const btQuaternion turn(btVector3(1, 2, 3).normalized(), btScalar(0.7));
  Cloth cloth([&](const btVector3& x) { return quatRotate(turn, x) + btVector3(1, 2, 3); });
  for (int i = 0; i < 25; ++i) EXPECT_EQ(cloth.share(i), 1) << i;
}

TEST(SpannedAreas, AreTheCosineOfHalfTheAngleAlongACrease) {
  for (const double angle : {0.5, 1.5, 3.0}) {
    Cloth cloth([&](const btVector3& x) {
      const double beyond = std::max(0.0, double(x.x()));
      const double before = std::min(0.0, double(x.x()));
      return btVector3(btScalar(before + beyond * std::cos(angle)), btScalar(beyond * std::sin(angle)), x.z());
    });
    EXPECT_NEAR(cloth.share(12), std::cos(angle / 2), 1e-5) << angle;
    EXPECT_EQ(cloth.share(10), 1) << "all of its triangles are on one side";
  }
}

TEST(SpannedAreas, AreNothingWhereAllNodesAreInOnePlaceAndWholeWhereOneIsNotFinite) {
  Cloth crushed([](const btVector3&) { return btVector3(1, 2, 3); });
  EXPECT_EQ(crushed.share(12), 0);
  crushed.body.m_nodes[12].m_x.setX(std::nanf(""));
  EXPECT_EQ(crushed.share(12), 1);
}

TEST(SpannedAreas, DoNotDependOnWhichWayRoundTrianglesAre) {
  const auto wave = [](const btVector3& x) {
    return btVector3(x.x() / 2, btScalar(0.1 * std::sin(double(9 * x.x() + 5 * x.z()))), x.z());
  };
  Cloth cloth(wave);
  Cloth mixed(wave);
  for (int f = 1; f < mixed.body.m_faces.size(); ++f) {
    if (f % 3 != 0) std::swap(mixed.body.m_faces[f].m_n[0], mixed.body.m_faces[f].m_n[f % 2 + 1]);
  }
  mixed.mesh = RestMesh(mixed.body);
  // Made of the bent shape, but its links know the lengths at rest.
  for (int i = 0; i < 25; ++i) EXPECT_NEAR(mixed.share(i), cloth.share(i), 1e-6) << i;
  EXPECT_LT(cloth.share(12), 0.95);
}

}  // namespace
}  // namespace wetcloth_test::spanned_areas_test
