// SPDX-License-Identifier: Zlib
// Where an edge is while it turns and comes nearer to the opposite one.

#include "command/scene/Twist.h"

#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

namespace wetcloth_test::twist_test {
namespace {

using command::Twist;
using command::TwistScene;
using Edge = wetcloth::ClothPatch::Edge;

constexpr double kRounding = 1e-6;

/// An upright square of 1 m x 1 m, 3 x 3 nodes.
struct Square {
  BodyScene scene{WorldKind::softRigid, hangingPatch(3)};
  btVector3 at(int node) { return scene.body().m_nodes[node].m_x; }
  Twist twist(const TwistScene& how) { return {scene.body(), hangingPatch(3), how}; }
};

TEST(Twist, ComesNearerInProportionToItsTurns) {
  Square square;
  Twist twist = square.twist({Edge::top, 0.25, 0.5, 0.6});
  twist.moveTo(1);  // half of the half turn
  EXPECT_NEAR((square.at(6) - btVector3(0.5, 0.7f, 0.5)).length(), 0, kRounding);
  EXPECT_NEAR((square.at(7) - btVector3(0.5, 0.7f, 0)).length(), 0, kRounding);
  for (const double time : {2.0, 100.0}) {
    twist.moveTo(time);
    EXPECT_NEAR((square.at(6) - btVector3(1, 0.4f, 0)).length(), 0, kRounding) << time;
  }
}

TEST(Twist, EachEdgeComesTowardsTheOppositeOne) {
  for (const Edge edge : {Edge::left, Edge::right, Edge::bottom, Edge::top}) {
    Square square;
    const int middle = edge == Edge::left ? 3 : edge == Edge::right ? 5 : edge == Edge::bottom ? 1 : 7;
    const btVector3 before = square.at(middle);
    square.twist({edge, 1, 1, 0.25}).moveTo(1);
    const btVector3 way = btVector3(0.5, 0.5, 0) - before;
    EXPECT_NEAR((square.at(middle) - before - way / 2).length(), 0, kRounding);
  }
}

TEST(Twist, BackwardsStopsAfterItsTurnsToo) {
  Square square;
  Twist twist = square.twist({Edge::top, -0.25, 0.25, 0.5});
  twist.moveTo(100);
  EXPECT_NEAR((square.at(6) - btVector3(0.5, 0.5, -0.5)).length(), 0, kRounding);
}

TEST(Twist, WithoutTurnsItStays) {
  Square square;
  const btVector3 before = square.at(6);
  square.twist({Edge::top, 1, 0, 0.5}).moveTo(1);
  EXPECT_EQ(square.at(6), before);
}

}  // namespace
}  // namespace wetcloth_test::twist_test
