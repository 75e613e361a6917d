// SPDX-License-Identifier: Zlib
// What a mesh is like, told before Bullet sees it: each fault that meshes from the field have, on a mesh made for it.

#include "bullet_wetcloth/mesh/MeshCheck.h"
#include "bullet_wetcloth/mesh/ClothPatch.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wetcloth_test::mesh_check_test {
namespace {

using wetcloth::checkMesh;
using wetcloth::MeshReport;
using Triangles = std::vector<std::array<int, 3>>;

const std::vector<btVector3> kSquare = {btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(1, 1, 0), btVector3(0, 1, 0)};
const Triangles kHalves = {{0, 1, 2}, {0, 2, 3}};

TEST(MeshCheck, HasNothingToTellOfASheetInOnePiece) {
  const MeshReport report = checkMesh(kSquare, kHalves);
  EXPECT_EQ(report.nodes, 4);
  EXPECT_EQ(report.faces, 2);
  EXPECT_EQ(report.parts, 1);
  EXPECT_EQ(report.facePieces, 1);
  EXPECT_NEAR(report.size, std::sqrt(2.), 1e-6);
  EXPECT_NEAR(report.tolerance, 1e-6 * std::sqrt(2.), 1e-12);
  EXPECT_EQ(report.firstAt, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(report.summary(), "");
  EXPECT_TRUE(report.bulletBuildsFaceTree());
}

TEST(MeshCheck, NodesNearerThanTheToleranceAreInOnePlace) {
  std::vector<btVector3> nodes = kSquare;
  nodes.push_back(btVector3(1, 1, 0) + btVector3(btScalar(0.5e-6), btScalar(-0.5e-6), 0));
  nodes.push_back(btVector3(1, 1, btScalar(1e-5)));
  const MeshReport report = checkMesh(nodes, {{0, 1, 2}, {0, 4, 3}, {5, 1, 3}});
  EXPECT_EQ(report.firstAt, (std::vector<int>{0, 1, 2, 3, 2, 5}));
  EXPECT_EQ(report.coincidentNodes, 1);
}

TEST(MeshCheck, FindsCoincidentNodesWhereverTheyAre) {
  std::vector<btVector3> nodes;
  for (int copy = 0; copy < 2; ++copy) {
    for (int i = 0; i < 1000; ++i) {
      nodes.push_back(btVector3(btScalar(-3 + 0.0137 * i), btScalar(7 * std::sin(i)), btScalar(100 + 5 * std::cos(i))));
    }
  }
  const MeshReport report = checkMesh(nodes, {});
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(report.firstAt[std::size_t(1000 + i)], i);
}

TEST(MeshCheck, CountsPartsAndTheirPieces) {
  std::vector<btVector3> nodes = kSquare;
  nodes.insert(nodes.end(), {btVector3(2, 1, 0), btVector3(2, 2, 0), btVector3(3, 2, 0)});
  const MeshReport apart = checkMesh(nodes, {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}});
  EXPECT_EQ(apart.parts, 2);
  EXPECT_EQ(apart.facePieces, 2);
  EXPECT_FALSE(apart.bulletBuildsFaceTree());
  EXPECT_NE(apart.summary().find("2 parts"), std::string::npos) << apart.summary();
  const MeshReport bowTie = checkMesh(nodes, {{0, 1, 2}, {0, 2, 3}, {2, 4, 5}});
  EXPECT_EQ(bowTie.parts, 1);
  EXPECT_EQ(bowTie.facePieces, 2);
  EXPECT_FALSE(bowTie.bulletBuildsFaceTree());
  EXPECT_EQ(bowTie.strayNodes, std::vector<int>{6});
}

TEST(MeshCheck, TellsFacesThatAreThereTwiceEitherWayRound) {
  const MeshReport report = checkMesh(kSquare, {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 0, 2}});
  EXPECT_EQ(report.doubledFaces, (std::vector<int>{2, 3}));
  EXPECT_TRUE(report.nonManifoldEdges.empty());  // one sheet, four times on its diagonal
}

TEST(MeshCheck, TellsEdgesOfThreeFaces) {
  std::vector<btVector3> nodes = kSquare;
  nodes.push_back(btVector3(0, 0, 1));
  const MeshReport report = checkMesh(nodes, {{0, 1, 2}, {0, 2, 3}, {2, 0, 4}});
  ASSERT_EQ(report.nonManifoldEdges.size(), 1u);
  EXPECT_EQ(report.nonManifoldEdges[0], (std::array<int, 2>{0, 2}));
}

TEST(MeshCheck, TellsFacesWithoutArea) {
  std::vector<btVector3> nodes = kSquare;
  nodes.push_back(btVector3(btScalar(0.3), btScalar(0.3), 0));
  const MeshReport report = checkMesh(nodes, {{0, 1, 2}, {0, 4, 2}, {3, 3, 0}});
  EXPECT_EQ(report.degenerateFaces, (std::vector<int>{1, 2}));
}

TEST(MeshCheck, OfABodyLooksAtItsLinksToo) {
  btSoftBodyWorldInfo info;
  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = 5;
  EXPECT_TRUE(checkMesh(*patch.build(info)).bulletBuildsFaceTree());
  const btScalar masses[] = {1, 1, 1, 1};
  btSoftBody body(&info, 4, kSquare.data(), masses);
  EXPECT_EQ(checkMesh(body).nodePieces, 4);
  EXPECT_FALSE(checkMesh(body).bulletBuildsFaceTree());
  body.appendLink(0, 1);
  body.appendLink(1, 2);
  MeshReport rope = checkMesh(body);
  EXPECT_EQ(rope.parts, 1);
  EXPECT_EQ(rope.nodePieces, 2);
  EXPECT_EQ(rope.strayNodes, std::vector<int>{3});
  body.appendLink(2, 3);
  EXPECT_TRUE(checkMesh(body).bulletBuildsFaceTree());
}

TEST(MeshCheck, TakesWhatIsNoMesh) {
  EXPECT_EQ(checkMesh({}, {}).parts, 0);
  const btScalar nothing = std::numeric_limits<btScalar>::quiet_NaN();
  EXPECT_EQ(checkMesh({btVector3(nothing, 0, 0), btVector3(0, 0, 0), btVector3(0, 0, 0)}, {{0, 1, 2}}).coincidentNodes,
            1);
}

}  // namespace
}  // namespace wetcloth_test::mesh_check_test
