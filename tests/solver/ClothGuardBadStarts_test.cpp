// SPDX-License-Identifier: Zlib
// What the guard cannot hold apart it tells, and goes on.
#include "tests/solver/GuardScene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace wetcloth_test::cloth_guard_bad_starts_test {
namespace {

// A level sheet, and one upright through its middle.
void addCrossedCloths(GuardScene& scene, btSoftBody*& level, btSoftBody*& upright) {
  level = &scene.add(levelSheet(9, 0.5, btVector3(0, 0, 0)));
  wetcloth::ClothPatch patch = squarePatch(10);
  patch.origin = btVector3(btScalar(-0.23), btScalar(-0.23), btScalar(0.017));
  patch.edgeU = btVector3(btScalar(0.5), 0, 0);
  patch.edgeV = btVector3(0, btScalar(0.5), btScalar(0.01));
  upright = &scene.add(patch);
}

/// After half a second of it: only damping and the other cloth act on each.
void expectFallOn(const btSoftBody& body) {
  const double fall = 9.81 * 0.5;
  ASSERT_TRUE(isFinite(body));
  EXPECT_NEAR(double(meanVelocity(body).y()), -fall, 0.3);
  EXPECT_LT(largestSpeed(body), fall + 2);
}

TEST(ClothGuardBadStarts, ClothsThatAreEntangledFallOn) {
  GuardScene scene;
  btSoftBody* level = nullptr;
  btSoftBody* upright = nullptr;
  addCrossedCloths(scene, level, upright);
  scene.step(30);
  for (const btSoftBody* body : {level, upright}) {
    expectFallOn(*body);
    EXPECT_LT(largestStretch(*body), 1.3);
  }
  EXPECT_EQ(scene.totals().halts, 0);
}

TEST(ClothGuardBadStarts, ClothsThatCrossAreTold) {
  GuardScene scene;
  btSoftBody* level = nullptr;
  btSoftBody* upright = nullptr;
  addCrossedCloths(scene, level, upright);
  scene.step(1);
  EXPECT_GT(scene.totals().meeting, 0);
}

// An upright sheet of 10 columns cuts a level one of 9 along a line: its 9 spaces between columns have an edge along
// each column and a diagonal, and where these cross the level sheet is in one of its faces; and the level sheet's edges
// cross it.
TEST(ClothGuardBadStarts, CrossingEdgesAndFacesAreCountedWhenAClothIsNew) {
  GuardScene scene;
  btSoftBody* level = nullptr;
  btSoftBody* upright = nullptr;
  addCrossedCloths(scene, level, upright);
  std::string told;
  scene.solver().setLog([&told](const std::string& message) { told = message; });
  scene.step(1);
  const long long crossing = scene.totals().crossing;
  // Upright: 10 edges along columns and 9 diagonals. Level: along 0.5 m its 9 columns of edges and 8 diagonals.
  EXPECT_GE(crossing, 10 + 9 + 8 - 4);
  EXPECT_LE(crossing, 10 + 9 + 9 + 8 + 4);
  EXPECT_NE(told.find(std::to_string(crossing)), std::string::npos) << told;
  scene.solver().resetGuardTotals();
  scene.step(5);
  EXPECT_EQ(scene.totals().crossing, 0) << "none is new";
}

TEST(ClothGuardBadStarts, NothingCrossesInClothsThatLieOnEachOther) {
  GuardScene scene;
  scene.add(levelSheet(9, 0.5, btVector3(0, 0, 0)));
  scene.add(levelSheet(9, 0.5, btVector3(btScalar(0.01), btScalar(0.0001), btScalar(0.02))));
  scene.step(1);
  EXPECT_EQ(scene.totals().crossing, 0);
}

// Edges of both cross each other, in numbers that float32 has.
TEST(ClothGuardBadStarts, ClothsInOnePlaneMeetAndAreTold) {
  GuardScene scene;
  btSoftBody& first = scene.add(levelSheet(9, 0.5, btVector3(0, 0, 0)));
  btSoftBody& second = scene.add(levelSheet(9, 0.5, btVector3(btScalar(0.03125), 0, btScalar(0.015625))));
  ASSERT_GT(scene.watch().meetings(), 100);
  scene.step(1);
  EXPECT_GT(scene.totals().meeting, 100);
  scene.step(29);
  expectFallOn(first);
  expectFallOn(second);
  EXPECT_EQ(scene.totals().halts, 0);
}

TEST(ClothGuardBadStarts, WhatIsNotEntangledIsStillHeldApart) {
  GuardScene scene;
  scene.addFloor();
  scene.add(wavySheet(10, 0.6));
  scene.add(wavySheet(11, 0.6, btVector3(btScalar(0.03), btScalar(0.07), btScalar(0.04))));
  PassageCheck& others = scene.watch();  // of these two
  wetcloth::ClothPatch patch = levelSheet(6, 0.3, btVector3(2, btScalar(0.3), 0));
  scene.add(patch);
  patch.edgeU = btVector3(0, btScalar(0.3), btScalar(0.02));
  patch.origin += btVector3(btScalar(0.14), btScalar(-0.13), btScalar(0.01));
  scene.add(patch);
  scene.step(75);
  EXPECT_EQ(others.smallSteps(), 750);
  EXPECT_EQ(others.passages(), 0);
  EXPECT_EQ(scene.totals().halts, 0);
}

// A sheet whose four edges are pinned, and a small one above it.
struct Drum {
  explicit Drum(GuardScene& scene, bool isAllPinned) {
    wetcloth::ClothPatch patch = levelSheet(9, 0.5, btVector3(0, 0, 0));
    using Edge = wetcloth::ClothPatch::Edge;
    patch.pinnedEdges = {Edge::left, Edge::right, Edge::bottom, Edge::top};
    for (int k = 0; isAllPinned && k < patch.nodeCount(); ++k) patch.pinnedNodes.push_back(k);
    drum = &scene.add(patch);
    patch = levelSheet(4, 0.15, btVector3(btScalar(0.01), btScalar(0.1), btScalar(0.02)));
    for (int k = 0; k < patch.nodeCount(); ++k) {
      if (isAllPinned || k == 5) patch.pinnedNodes.push_back(k);
    }
    small = &scene.add(patch);
  }
  void teleport(double way) const {
    for (int k = 0; k < small->m_nodes.size(); ++k) {
      btSoftBody::Node& node = small->m_nodes[k];
      if (node.m_im == 0) node.m_x += btVector3(0, btScalar(way), 0);
    }
  }
  btSoftBody* drum;
  btSoftBody* small;
};

TEST(ClothGuardBadStarts, AClothThatIsPutThroughAnotherIsTold) {
  GuardScene scene;
  const Drum drum(scene, true);
  scene.watch();
  scene.step(5);
  drum.teleport(-0.5);
  scene.step(5);
  EXPECT_GT(scene.passages(), 0);
  EXPECT_GT(scene.totals().forced + scene.totals().meeting, 0);
  EXPECT_TRUE(isFinite(*drum.drum));
  EXPECT_TRUE(isFinite(*drum.small));
}

TEST(ClothGuardBadStarts, APinThatIsPutThroughAClothIsToldOrHoldsIt) {
  for (const double way : {-0.3, -3.0, -300.0}) {
    GuardScene scene;
    const Drum drum(scene, false);
    scene.watch();
    scene.step(5);
    drum.teleport(way);
    scene.step(1);
    drum.teleport(-way);
    scene.step(30);
    EXPECT_TRUE(scene.passages() == 0 || scene.totals().forced + scene.totals().meeting > 0) << way;
    EXPECT_TRUE(isFinite(*drum.drum)) << way;
    EXPECT_TRUE(isFinite(*drum.small)) << way;
    EXPECT_TRUE(way < -1 || scene.totals().halts == 0) << way;  // further, the cloth may have to wait for the pin
  }
}

// Half the thickness from an edge, 0.4 mm beside its pinned end: to part them there the other end, 1 m away, would have
// to go 2.5 m. It goes four times 5 % of what is missing in each of 100 small steps, for each of two pairs: 4 cm, and
// not 16 m.
TEST(ClothGuardBadStarts, WhatTouchesRightBesideAPinThrowsNothingAway) {
  GuardScene scene(Guard(), WorldKind::softRigid, btVector3(0, 0, 0));
  btSoftBody& body = scene.add(linkedTriangles({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 1, 2}}));
  body.setMass(0, 0);
  body.setMass(2, 0);
  const btScalar x = btScalar(0.0004);
  const btScalar y = btScalar(0.001);
  btSoftBody& other = scene.add(linkedTriangles(
      {{x, y, btScalar(-0.5)}, {x, y, btScalar(0.5)}, {btScalar(-0.5), btScalar(0.5), 0}}, {{0, 1, 2}}));
  for (int k = 0; k < 3; ++k) other.setMass(k, 0);
  scene.step(10);
  ASSERT_GT(scene.totals().pairs, 0);
  EXPECT_LT(double((body.m_nodes[1].m_x - btVector3(1, 0, 0)).length()), 0.05);
  EXPECT_LT(largestSpeed(body), 0.1);
}

// All nodes at one place: no edge has a length, and what the guard reckons in edges is 0.
TEST(ClothGuardBadStarts, FacesWithoutLengthAreStepped) {
  for (const std::size_t nodes : {3u, 4u, 9u}) {
    GuardScene scene;
    scene.addFloor(-0.5);
    std::vector<std::array<int, 3>> faces;
    for (int k = 0; k + 2 < int(nodes); ++k) faces.push_back({k, k + 1, k + 2});
    btSoftBody& body = scene.add(linkedTriangles(std::vector<btVector3>(nodes, btVector3(0, 0, 0)), faces));
    btSoftBody& beside = scene.add(levelSheet(5, 0.5, btVector3(2, 0, 0)));
    scene.step(5);
    EXPECT_TRUE(isFinite(body));
    EXPECT_TRUE(isFinite(beside));
    scene.forgetLast();
    scene.step(30);
    EXPECT_TRUE(isFinite(body));
  }
}

}  // namespace
}  // namespace wetcloth_test::cloth_guard_bad_starts_test
