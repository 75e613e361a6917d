// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardStops.h"

#include "tests/solver/GuardScene.h"
#include "tests/support/Pi.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace wetcloth_test::guard_stops_test {
namespace {

using wetcloth::GuardNodes;
using wetcloth::GuardStops;

// Along x, one metre apart; the first one is imposed.
GuardNodes nodesInARow(std::size_t count) {
  GuardNodes nodes;
  nodes.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    nodes.to[k] = {{btScalar(k), 0, 0, 0}};
    nodes.inverseMass[k] = k == 0 ? btScalar(0) : btScalar(1);
  }
  return nodes;
}

TEST(GuardStops, ATimeGoesOnOverStepsUntilANodeIsFree) {
  const GuardNodes nodes = nodesInARow(4);
  const btScalar h = btScalar(0.25);
  GuardStops stops;
  stops.begin(4, false);
  for (const std::vector<int>& slowed : {std::vector<int>{1, 2, 2}, {2}}) {
    stops.add(slowed);
    stops.endSmallStep(h, nodes, btVector3(0, 5, 0));
  }
  EXPECT_DOUBLE_EQ(stops.longest(), 0.5);
  EXPECT_TRUE(stops.wasStopped(1));
  EXPECT_FALSE(stops.wasStopped(3));
  stops.begin(4, true);
  EXPECT_FALSE(stops.wasStopped(1));
  stops.add({2, 9});  // the second one is of a body
  stops.endSmallStep(h, nodes, btVector3(0, 5, 0));
  EXPECT_DOUBLE_EQ(stops.longest(), 0.75);
  stops.endSmallStep(h, nodes, btVector3(0, 5, 0));
  stops.add({2});
  stops.endSmallStep(h, nodes, btVector3(0, 5, 0));
  EXPECT_DOUBLE_EQ(stops.longest(), 0.75);
  EXPECT_EQ(stops.most(), 2);
  EXPECT_EQ(stops.placeOfMost(), btVector3(btScalar(1.5), 5, 0));
  stops.addAll(nodes);
  stops.endSmallStep(h, nodes, btVector3(0, 5, 0));
  EXPECT_EQ(stops.most(), 3);
  stops.reset();
  EXPECT_EQ(stops.most(), 0);
  EXPECT_EQ(stops.longest(), 0);
}

TEST(GuardStops, OfAnotherClothNothingIsKnown) {
  const GuardNodes nodes = nodesInARow(4);
  GuardStops stops;
  stops.begin(4, false);
  stops.add({1});
  stops.endSmallStep(btScalar(0.25), nodes, btVector3(0, 0, 0));
  stops.begin(4, false);
  stops.add({1});
  stops.endSmallStep(btScalar(0.25), nodes, btVector3(0, 0, 0));
  EXPECT_DOUBLE_EQ(stops.longest(), 0.25);
}

// A strip is wrung between rods that stay apart: its middle is where it has to be stopped.
TEST(GuardStops, AStripThatIsWrungIsStoppedInItsMiddle) {
  GuardScene scene;
  wetcloth::ClothPatch patch = squarePatch(9);
  patch.rows = 17;
  patch.edgeU = btVector3(btScalar(0.3), 0, 0);
  patch.edgeV = btVector3(0, btScalar(0.6), 0);
  patch.origin = btVector3(btScalar(-0.15), 0, 0);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top, wetcloth::ClothPatch::Edge::bottom};
  btSoftBody& body = scene.add(patch);
  std::vector<int> stopped;
  for (int step = 0; step < 150 && stopped.empty(); ++step) {
    const double angle = 2 * kPi * (step + 1) / 60;
    for (int i = 0; i < patch.columns; ++i) {
      const double x = -0.15 + 0.3 * i / (patch.columns - 1);
      body.m_nodes[patch.node(i, patch.rows - 1)].m_x =
          btVector3(btScalar(x * std::cos(angle)), btScalar(0.6), btScalar(x * std::sin(angle)));
    }
    scene.step(1);
    stopped = scene.solver().stoppedNodes(body);
  }
  ASSERT_FALSE(stopped.empty());
  for (const int node : stopped) EXPECT_LT(node, body.m_nodes.size());
  const wetcloth::ClothSolver::GuardTotals totals = scene.totals();
  EXPECT_GT(totals.longestStop, 0);
  EXPECT_GE(totals.mostStopped, 1);
  EXPECT_LE(totals.mostStopped, static_cast<long long>(stopped.size()));
  EXPECT_LT(std::fabs(double(totals.placeOfMost.x())), 0.15);
  EXPECT_GT(double(totals.placeOfMost.y()), 0.1);
  EXPECT_LT(double(totals.placeOfMost.y()), 0.5);
}

}  // namespace
}  // namespace wetcloth_test::guard_stops_test
