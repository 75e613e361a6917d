// SPDX-License-Identifier: Zlib
// Signs by which all triangles of a cloth look to one side of it.

#include "bullet_wetcloth/mesh/FaceWinding.h"

#include "bullet_wetcloth/mesh/RestMesh.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/SoftBodies.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace wetcloth_test::face_winding_test {
namespace {

using wetcloth::RestMesh;

std::vector<int> windingsOf(const std::vector<btVector3>& nodes, const std::vector<std::array<int, 3>>& faces) {
  BodyScene scene(WorldKind::softRigid, triangles(nodes, std::vector<btScalar>(nodes.size(), 1), faces));
  return wetcloth::faceWindings(RestMesh(scene.body()));
}

const std::vector<btVector3> kNodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                       {0, 0, 1}, {5, 0, 0}, {5, 1, 0}, {6, 0, 0}};
using Signs = std::vector<int>;

TEST(FaceWindings, AgreeAcrossAnEdge) {
  EXPECT_EQ(windingsOf(kNodes, {{0, 1, 2}, {1, 3, 2}}), (Signs{1, 1}));
  EXPECT_EQ(windingsOf(kNodes, {{0, 1, 2}, {1, 2, 3}}), (Signs{1, -1}));
}

TEST(FaceWindings, BeginAnewInEachPiece) {
  EXPECT_EQ(windingsOf(kNodes, {{0, 1, 2}, {5, 7, 6}, {1, 2, 3}}), (Signs{1, 1, -1}));
}

TEST(FaceWindings, AreNoneOfTrianglesThatAreThereTwice) {
  EXPECT_EQ(windingsOf(kNodes, {{0, 1, 2}, {2, 1, 0}, {1, 2, 3}}), (Signs{1, 0, -1}));
}

TEST(FaceWindings, DoNotSpreadAcrossAnEdgeOfThree) {
  EXPECT_EQ(windingsOf(kNodes, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}), (Signs{1, 1, 1}));
}

}  // namespace
}  // namespace wetcloth_test::face_winding_test
