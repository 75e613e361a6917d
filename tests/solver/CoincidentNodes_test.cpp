// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/CoincidentNodes.h"

#include "bullet_wetcloth/Precision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace wetcloth_test::coincident_nodes_test {
namespace {

using wetcloth::CoincidentNodes;
using wetcloth::GuardMesh;

std::vector<btVector3> along(const std::vector<double>& x) {
  std::vector<btVector3> places;
  for (const double k : x) places.emplace_back(btScalar(k), 0, 0);
  return places;
}

// Each has a neighbour of its own, 1 m beside it in its own direction, so that they are apart at 0.1 m.
struct Star {
  explicit Star(const std::vector<double>& x) : count(int(x.size())), places(along(x)) {
    nodes.find(places);
    std::vector<GuardMesh::Edge> edges;
    for (int k = 0; k < count; ++k) edges.push_back({{k, k + count}});
    for (int k = 0; k < count; ++k) places.push_back(places[std::size_t(k)] + direction(k));
    nodes.setEdges(edges, places);
  }
  btVector3 direction(int k) const {
    const btScalar angle = btScalar(SIMD_2_PI * k / count);
    return btVector3(btCos(angle), btSin(angle), 0);
  }
  /// Node k is now so far along its direction, and its neighbour with it.
  bool move(const std::vector<double>& ways) {
    std::vector<btVector3> now = places;
    for (int k = 0; k < count; ++k) {
      now[std::size_t(k)] += direction(k) * btScalar(ways[std::size_t(k)]);
      now[std::size_t(k) + std::size_t(count)] += direction(k) * btScalar(ways[std::size_t(k)]);
    }
    return nodes.separate([&now](int node) { return now[std::size_t(node)]; });
  }
  int first(int k) const { return nodes.first(k); }

  int count;
  std::vector<btVector3> places;
  CoincidentNodes nodes;
};

CoincidentNodes found(const std::vector<double>& x) {
  CoincidentNodes nodes;
  nodes.find(along(x));
  return nodes;
}

TEST(CoincidentNodes, AreNoneWhereAllPlacesDiffer) {
  const CoincidentNodes nodes = found({0, 1, 2, double(std::nextafter(2.F, 3.F))});
  EXPECT_TRUE(nodes.isEmpty());
  for (int k = 0; k < 4; ++k) EXPECT_EQ(nodes.first(k), k);
}

TEST(CoincidentNodes, CountAsTheFirstOfThem) {
  const CoincidentNodes nodes = found({5, 1, 5, 2, 1, 5});
  const int first[] = {0, 1, 0, 3, 1, 0};
  for (int k = 0; k < 6; ++k) EXPECT_EQ(nodes.first(k), first[k]);
}

// As numbers they are equal, and no distance apart.
TEST(CoincidentNodes, ZeroIsMinusZero) { EXPECT_EQ(found({0.0, -0.0}).first(1), 0); }

TEST(CoincidentNodes, StayOneWhenTheMeshGetsMoreNodes) {
  CoincidentNodes nodes = found({0, 0, 5});
  nodes.keepOf(6);
  nodes.find(along({0, 0.01, 5, 0.01, 7, 5}));
  const int first[] = {0, 0, 2, 0, 4, 2};
  for (int k = 0; k < 6; ++k) EXPECT_EQ(nodes.first(k), first[k]);
}

TEST(CoincidentNodes, AreForgottenWhenTheMeshGetsFewerNodes) {
  CoincidentNodes nodes = found({0, 0, 5});
  nodes.keepOf(2);
  EXPECT_TRUE(nodes.isEmpty());
  nodes.find(along({0, 1}));
  EXPECT_EQ(nodes.first(1), 1);
}

TEST(CoincidentNodes, StayOneAsLongAsTheyAreNear) {
  Star star({0, 0});
  EXPECT_FALSE(star.move({0, 0.09}));
  EXPECT_EQ(star.first(1), 0);
}

TEST(CoincidentNodes, DoNotComeTogetherAgain) {
  Star star({0, 0});
  EXPECT_TRUE(star.move({0, 0.11}));
  EXPECT_FALSE(star.move({0, 0}));
  EXPECT_EQ(star.first(1), 1);
  EXPECT_TRUE(star.nodes.isEmpty());
}

TEST(CoincidentNodes, ThatHaveJustLeftAreJoinedAgain) {
  Star star({0, 0, 0, 5});
  star.move({0, 1, 1, 1});
  EXPECT_FALSE(star.nodes.joinAgain(0, 3));
  EXPECT_TRUE(star.nodes.joinAgain(2, 0));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(star.first(k), 0);
}

TEST(CoincidentNodes, ThatLeftEarlierAreNot) {
  Star star({0, 0});
  star.move({0, 1});
  star.move({0, 1});
  EXPECT_FALSE(star.nodes.joinAgain(0, 1));
  EXPECT_EQ(star.first(1), 1);
}

TEST(CoincidentNodes, ThatGoIntoEachOtherHaveNotComeApart) {
  Star star({0, 0});
  star.move({-0.2, -0.2});
  EXPECT_EQ(star.first(1), 0);
}

// A sliver's edge, 0.01 m long, is turned over by less than a tenth of the others.
TEST(CoincidentNodes, ComeApartByTheShortestOfTheirEdges) {
  CoincidentNodes nodes;
  std::vector<btVector3> places = along({0, 0, 0.01, -1});
  nodes.find(places);
  nodes.setEdges({{{0, 3}}, {{1, 2}}}, places);
  const auto placeOf = [&places](int node) { return places[std::size_t(node)]; };
  places[1].setX(btScalar(0.0009));
  nodes.separate(placeOf);
  EXPECT_EQ(nodes.first(1), 0);
  places[1].setX(btScalar(0.0011));
  nodes.separate(placeOf);
  EXPECT_EQ(nodes.first(1), 1);
}

// Directions are 90 degrees from each other; 1 and 2 go the same way, in which 0 and 3 do not.
TEST(CoincidentNodes, ThatLeaveTogetherStayOne) {
  Star star({0, 0, 0, 0});
  std::vector<btVector3> now = star.places;
  for (const int k : {1, 2, 5, 6}) now[std::size_t(k)] += btVector3(-1, 1, 0);
  star.nodes.separate([&now](int node) { return now[std::size_t(node)]; });
  const int first[] = {0, 1, 1, 0};
  for (int k = 0; k < 4; ++k) EXPECT_EQ(star.first(k), first[k]);
  star.move({0, 1, 1, 0});
  EXPECT_EQ(star.first(2), 2) << "it has left 1";
  EXPECT_EQ(star.first(3), 0);
}

}  // namespace
}  // namespace wetcloth_test::coincident_nodes_test
