// SPDX-License-Identifier: Zlib
// Where an edge is while it turns and comes nearer to the opposite one.

#include "command/scene/Twist.h"

#include "command/scene/SceneReader.h"
#include "command/scene/SceneWorld.h"
#include "tests/command/Command.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

#include <sstream>

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

// The dry patch has the same mass at each corner and twice that between corners; what Bullet projects links by follows.
TEST(Twist, LetsGoOfNodesThatWeighWhatTheyDidBeforeTheyWerePinned) {
  wetcloth::ClothPatch patch = hangingPatch(3);
  patch.pinnedCorners.clear();
  patch.pinnedEdges = {};
  BodyScene free{WorldKind::softRigid, patch};
  Square square;
  for (const int node : {6, 7, 8}) square.scene.body().m_nodes[node].m_im = 0;
  square.scene.body().updateLinkConstants();
  TwistScene how{Edge::top, 0.25, 0.5, 0.6};
  how.letGo = 3;
  Twist twist = square.twist(how);
  twist.moveTo(2.99);
  EXPECT_EQ(square.scene.body().m_nodes[7].m_im, 0);
  twist.moveTo(3);
  const btVector3 there = square.at(7);
  square.scene.body().m_nodes[7].m_x += btVector3(0, 0, 1);
  twist.moveTo(4);
  EXPECT_EQ(square.at(7), there + btVector3(0, 0, 1)) << "is moved no more";
  for (int node = 0; node < 9; ++node) {
    EXPECT_NEAR(square.scene.body().m_nodes[node].m_im / free.body().m_nodes[node].m_im, 1, 1e-5) << node;
  }
  for (int k = 0; k < free.body().m_links.size(); ++k) {
    EXPECT_NEAR(square.scene.body().m_links[k].m_c0 / free.body().m_links[k].m_c0, 1, 1e-5) << k;
  }
}

/// A wet towel that is wrung for half a second and let go.
cli::Json wrungTowel() {
  cli::Json json = cli::smallScene();
  json["precision"] = cli::testedPrecision();
  json["solver"] = "wetcloth";
  cli::Json& cloth = json["cloths"][0];
  cloth["initial_saturation"] = 1;
  cloth["pins"] = {{"edges", {"left", "right"}}};
  cloth["twist"] = {{"edge", "right"}, {"turns", 0.25}, {"let_go_s", 0.5}};
  cloth["effects"] = {{"dripping", {{"squeeze", 1}}}};
  return json;
}

TEST(Twist, GoesOnFromAStateInWhichItHasLetGo) {
  const cli::TemporaryDirectory directory;
  const command::Scene scene = command::readScene(directory.write("scene.json", wrungTowel().dump()));
  command::SceneWorld world(scene);
  for (int i = 0; i < 36; ++i) world.step();
  std::stringstream state;
  world.save(state);
  command::SceneWorld other(scene);
  other.restore(state, 36);
  for (int i = 0; i < 20; ++i) {
    world.step();
    other.step();
  }
  const btSoftBody &body = *world.bodies()[0], &again = *other.bodies()[0];
  int fallen = 0;
  for (int node = 0; node < body.m_nodes.size(); ++node) {
    EXPECT_EQ(body.m_nodes[node].m_x, again.m_nodes[node].m_x) << node;
    fallen += body.m_nodes[node].m_im > 0 && body.m_nodes[node].m_v.y() < btScalar(-0.1) ? 1 : 0;
  }
  EXPECT_GT(fallen, 0) << "nothing was let go";
}

TEST(Twist, WithoutTurnsItStays) {
  Square square;
  const btVector3 before = square.at(6);
  square.twist({Edge::top, 1, 0, 0.5}).moveTo(1);
  EXPECT_EQ(square.at(6), before);
}

}  // namespace
}  // namespace wetcloth_test::twist_test
