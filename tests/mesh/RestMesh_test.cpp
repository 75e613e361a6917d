// SPDX-License-Identifier: Zlib
// A cloth's triangles at rest: known by the rest lengths of their edges, however the body is bent.

#include "bullet_wetcloth/mesh/RestMesh.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/Patches.h"
#include "tests/support/SoftBodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace wetcloth_test::rest_mesh_test {
namespace {

using wetcloth::RestMesh;

// A length is of positions rounded to Bullet's scalar, of 1 m at most.
constexpr double kRounding = kIsDouble ? 1e-14 : 1e-6;

/// A body without a world, of these nodes and triangles, and links where asked for.
struct Built {
  Built(const std::vector<btVector3>& positions, const std::vector<std::array<int, 3>>& faces)
      : body(triangles(positions, std::vector<btScalar>(positions.size(), 1), faces)(info)) {}
  explicit Built(const wetcloth::ClothPatch& patch) : body(patch.build(info)) {}
  void link(int a, int b, double length) {
    body->appendLink(a, b);
    body->m_links[body->m_links.size() - 1].m_rl = btScalar(length);
  }
  btSoftBodyWorldInfo info;
  std::unique_ptr<btSoftBody> body;
};

double sumOfAreas(const RestMesh& mesh) {
  double sum = 0;
  for (const RestMesh::Triangle& triangle : mesh.triangles()) sum += triangle.area;
  return sum;
}

std::vector<int> neighboursOf(const RestMesh& mesh, std::size_t node) {
  std::vector<int> nodes(mesh.neighbours(node).begin(), mesh.neighbours(node).end());
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

const std::vector<btVector3> kFour = {btVector3(0, 0, 0), btVector3(3, 0, 0), btVector3(0, 0, 4), btVector3(3, 0, 4)};

TEST(RestMesh, OfOneTriangle) {
  const Built built(kFour, {{0, 1, 2}});  // node 3 belongs to none
  const RestMesh mesh(*built.body);
  ASSERT_EQ(mesh.nodeCount(), 4u);
  ASSERT_EQ(mesh.triangles().size(), 1u);
  ASSERT_EQ(mesh.edges().size(), 3u);
  const RestMesh::Triangle& triangle = mesh.triangles()[0];
  EXPECT_NEAR(triangle.area, 6, 6 * kRounding);
  const double opposite[] = {5, 4, 3};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(triangle.nodes[k], int(k));
    const RestMesh::Edge& edge = mesh.edges()[std::size_t(triangle.edges[k])];
    EXPECT_NEAR(edge.length, opposite[k], 5 * kRounding) << k;
    EXPECT_LT(edge.a, edge.b);
    EXPECT_TRUE(edge.a != int(k) && edge.b != int(k)) << "opposite its node";
    EXPECT_NEAR(mesh.nodeAreas()[k], 2, 2 * kRounding);
  }
  EXPECT_EQ(mesh.nodeAreas()[3], 0);
  EXPECT_EQ(neighboursOf(mesh, 0), (std::vector<int>{1, 2}));
  EXPECT_TRUE(neighboursOf(mesh, 3).empty());
}

TEST(RestMesh, OfAPatchHasItsAreaAndEulersNumberOfEdges) {
  wetcloth::ClothPatch patch = levelPatch(7, 1);
  patch.rows = 5;
  const Built built(patch);
  const RestMesh mesh(*built.body);
  EXPECT_EQ(mesh.triangles().size(), 48u);
  EXPECT_EQ(mesh.edges().size(), 35u + 48u - 1u);  // V - E + F = 1
  EXPECT_NEAR(sumOfAreas(mesh), 1, kRounding);
  double sum = 0;
  for (const double area : mesh.nodeAreas()) sum += area;
  EXPECT_NEAR(sum, 1, kRounding);
  std::size_t ends = 0;
  for (std::size_t i = 0; i < 35; ++i) ends += neighboursOf(mesh, i).size();
  EXPECT_EQ(ends, 2 * mesh.edges().size());
  for (std::size_t e = 1; e < mesh.edges().size(); ++e) {
    const RestMesh::Edge& before = mesh.edges()[e - 1];
    const RestMesh::Edge& edge = mesh.edges()[e];
    EXPECT_TRUE(std::make_pair(before.a, before.b) < std::make_pair(edge.a, edge.b)) << "each once, in order";
  }
}

TEST(RestMesh, NeighboursAreThoseAcrossEdges) {
  const Built built(kFour, {{0, 1, 2}, {1, 3, 2}});
  const RestMesh mesh(*built.body);
  EXPECT_EQ(mesh.edges().size(), 5u);
  EXPECT_EQ(neighboursOf(mesh, 0), (std::vector<int>{1, 2}));
  EXPECT_EQ(neighboursOf(mesh, 1), (std::vector<int>{0, 2, 3}));
  EXPECT_EQ(mesh.triangles()[0].edges[0], mesh.triangles()[1].edges[1]) << "the one between 1 and 2";
  EXPECT_NEAR(mesh.nodeAreas()[1], 4, 4 * kRounding);
  EXPECT_NEAR(mesh.nodeAreas()[0], 2, 2 * kRounding);
}

// The patch's springs follow every edge: whatever is done to the nodes, the mesh is the same.
TEST(RestMesh, IsTheSameHoweverTheBodyIsBent) {
  const Built built(levelPatch(6, 1));
  const RestMesh flat(*built.body);
  for (int i = 0; i < 36; ++i) {
    btVector3& x = built.body->m_nodes[i].m_x;
    x = btVector3(btScalar(0.5) * x.x(), btScalar(std::sin(5 * double(x.x()))), x.z() + x.x());
  }
  const RestMesh bent(*built.body);
  ASSERT_EQ(bent.edges().size(), flat.edges().size());
  for (std::size_t e = 0; e < flat.edges().size(); ++e) EXPECT_EQ(bent.edges()[e].length, flat.edges()[e].length) << e;
  for (std::size_t f = 0; f < flat.triangles().size(); ++f) {
    EXPECT_EQ(bent.triangles()[f].area, flat.triangles()[f].area) << f;
  }
  EXPECT_NEAR(sumOfAreas(bent), 1, kRounding);
}

TEST(RestMesh, TakesALinksRestLengthAndThePresentLengthWhereThereIsNone) {
  Built built(kFour, {{0, 1, 2}});
  built.link(1, 0, 6);    // in either order
  built.link(2, 3, 100);  // along no edge
  const RestMesh mesh(*built.body);
  ASSERT_EQ(mesh.edges().size(), 3u);
  EXPECT_EQ(mesh.edges()[0].length, 6);                   // 0 - 1
  EXPECT_NEAR(mesh.edges()[1].length, 4, 4 * kRounding);  // 0 - 2
  EXPECT_NEAR(mesh.edges()[2].length, 5, 5 * kRounding);  // 1 - 2
  const double s = 7.5;                                   // Heron: sides 6, 4, 5
  EXPECT_NEAR(mesh.triangles()[0].area, std::sqrt(s * (s - 6) * (s - 4) * (s - 5)), 10 * kRounding);
}

TEST(RestMesh, IgnoresALinkWithoutALength) {
  for (const double bad : {0.0, -1.0, double(std::numeric_limits<btScalar>::quiet_NaN()),
                           double(std::numeric_limits<btScalar>::infinity())}) {
    Built built(kFour, {{0, 1, 2}});
    built.link(0, 1, bad);
    EXPECT_NEAR(RestMesh(*built.body).edges()[0].length, 3, 3 * kRounding) << bad;
  }
}

TEST(RestMesh, LengthsThatMakeNoTriangleHaveNoArea) {
  Built built(kFour, {{0, 1, 2}});
  built.link(0, 1, 100);
  EXPECT_EQ(RestMesh(*built.body).triangles()[0].area, 0);
}

TEST(RestMesh, ANeedleKeepsItsArea) {
  const double thin = 1e-4;  // Heron's formula as it is written loses all of it in float64 at 1e-8, and this in float32
  const Built built({btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(btScalar(0.5), 0, btScalar(thin))}, {{0, 1, 2}});
  // The height is known to the rounding of the two long sides: h dh = l dl.
  EXPECT_NEAR(RestMesh(*built.body).triangles()[0].area, thin / 2, kIsDouble ? 1e-12 : 1e-3);
}

TEST(RestMesh, DegenerateTrianglesHaveNoAreaAndDoNoHarm) {
  const Built built({btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(2, 0, 0), btVector3(0, 0, 0)},
                    {{0, 3, 1}, {1, 2, 3}, {0, 1, 2}, {0, 3, 1}});
  const auto rewrite = [&](int face, std::array<int, 3> nodes) {  // appendFace() would refuse these
    for (std::size_t k = 0; k < 3; ++k) built.body->m_faces[face].m_n[k] = &built.body->m_nodes[nodes[k]];
  };
  rewrite(0, {0, 0, 1});
  rewrite(1, {2, 2, 2});
  const RestMesh mesh(*built.body);
  ASSERT_EQ(mesh.triangles().size(), 4u);
  for (const RestMesh::Triangle& triangle : mesh.triangles()) EXPECT_EQ(triangle.area, 0);
  for (const double area : mesh.nodeAreas()) EXPECT_EQ(area, 0);
  EXPECT_EQ(mesh.triangles()[0].edges[0], mesh.triangles()[2].edges[2]) << "0 - 1";
  EXPECT_EQ(mesh.triangles()[0].edges[1], mesh.triangles()[0].edges[0]) << "0 - 1, twice";
  EXPECT_EQ(mesh.triangles()[1].edges[0], -1) << "no edge from a node to itself";
  EXPECT_EQ(mesh.edges().size(), 5u);  // 0-1, 0-2, 0-3, 1-2, 1-3
}

TEST(RestMesh, ThreeTrianglesMayShareAnEdge) {
  const Built built(
      {btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 0, 1), btVector3(0, 1, 0), btVector3(0, 0, -1)},
      {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  const RestMesh mesh(*built.body);
  EXPECT_EQ(mesh.edges().size(), 7u);
  for (const RestMesh::Triangle& triangle : mesh.triangles()) {
    EXPECT_EQ(triangle.edges[2], 0) << "0 - 1 is the first in order";
    EXPECT_NEAR(triangle.area, 0.5, kRounding);
  }
  EXPECT_EQ(neighboursOf(mesh, 0), (std::vector<int>{1, 2, 3, 4}));
  EXPECT_NEAR(mesh.nodeAreas()[0], 0.5, kRounding);
}

TEST(RestMesh, OfABodyWithoutFacesIsEmpty) {
  btSoftBodyWorldInfo info;
  const std::unique_ptr<btSoftBody> rope = hangingRope(3, 0.1, 0.01)(info);
  const RestMesh mesh(*rope);
  EXPECT_EQ(mesh.nodeCount(), 4u);
  EXPECT_TRUE(mesh.edges().empty());
  EXPECT_TRUE(mesh.triangles().empty());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(mesh.nodeAreas()[i], 0);
    EXPECT_TRUE(neighboursOf(mesh, i).empty());
  }
}

TEST(RestMesh, PlacesThatAreNoNumbersMakeNoArea) {
  Built built(kFour, {{0, 1, 2}, {1, 3, 2}});
  built.body->m_nodes[0].m_x.setX(std::numeric_limits<btScalar>::quiet_NaN());
  const RestMesh mesh(*built.body);
  EXPECT_EQ(mesh.triangles()[0].area, 0);
  EXPECT_NEAR(mesh.triangles()[1].area, 6, 6 * kRounding);
}

TEST(RestMeshOfACloth, IsBuiltOnceAndAgainAfterTheBodyChanged) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, levelPatch(5, 1));
  scene.wet().setLog([](const std::string&) {});
  const RestMesh* const first = &scene.cloth().restMesh();
  EXPECT_EQ(first->nodeCount(), 25u);
  const RestMesh::Edge* const edges = first->edges().data();
  scene.step(3);
  EXPECT_EQ(scene.cloth().restMesh().edges().data(), edges);
  btSoftBody& body = scene.body();
  ASSERT_TRUE(body.cutLink(body.m_faces[0].m_n[0], body.m_faces[0].m_n[1], btScalar(0.5)));
  scene.cloth().setSaturation(0.1);
  EXPECT_EQ(scene.cloth().restMesh().nodeCount(), 27u);
}

}  // namespace
}  // namespace wetcloth_test::rest_mesh_test
