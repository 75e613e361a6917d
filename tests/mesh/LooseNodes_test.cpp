// SPDX-License-Identifier: Zlib
// Bodies of many nodes, whose tree Bullet's own constructor makes too slowly.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace wetcloth_test::loose_nodes_test {
namespace {

constexpr int manyAlong = 150;  // more than Bullet's constructor is left to do

struct Grid {
  std::vector<btVector3> positions;
  std::vector<btScalar> masses;
};

/// Row by row, of different masses, some pinned.
Grid grid(int along) {
  Grid nodes;
  for (int i = 0; i < along * along; ++i) {
    const int column = i % along, row = i / along;
    nodes.positions.emplace_back(btScalar(column) / along, btScalar(0.3) * btScalar(row) / along,
                                 btScalar(row) / along);
    nodes.masses.push_back(i % 7 == 0 ? 0 : btScalar(0.001) * btScalar(1 + i % 5));
  }
  return nodes;
}

std::unique_ptr<btSoftBody> bulletsOwn(btSoftBodyWorldInfo& info, const Grid& nodes) {
  return std::make_unique<btSoftBody>(&info, static_cast<int>(nodes.positions.size()), nodes.positions.data(),
                                      nodes.masses.data());
}

/// Checks a tree's boxes and ways up; its leaves, and how deep it is.
struct Tree {
  std::set<void*> leaves;
  int depth = 0;

  void look(const btDbvtNode* node, int level = 1) {
    depth = std::max(depth, level);
    if (node->isleaf()) {
      leaves.insert(node->data);
      return;
    }
    for (const btDbvtNode* child : node->childs) {
      ASSERT_EQ(child->parent, node);
      ASSERT_TRUE(node->volume.Contain(child->volume));
      look(child, level + 1);
    }
  }
};

TEST(LooseNodes, HaveATreeOfEveryNodeOnceWhichIsNotDeep) {
  ASSERT_GT(manyAlong * manyAlong, wetcloth::mostNodesForBullet);
  btSoftBodyWorldInfo info;
  const auto body = wetcloth::looseNodes(info, grid(manyAlong).positions);
  Tree tree;
  tree.look(body->m_ndbvt.m_root);
  EXPECT_EQ(static_cast<int>(tree.leaves.size()), manyAlong * manyAlong);
  EXPECT_EQ(body->m_ndbvt.m_leaves, manyAlong * manyAlong);
  EXPECT_EQ(body->m_ndbvt.m_root->parent, nullptr);
  EXPECT_LE(tree.depth, 17);  // 2^15 > 150 * 150
  for (int i = 0; i < body->m_nodes.size(); ++i) ASSERT_EQ(body->m_nodes[i].m_leaf->data, &body->m_nodes[i]);
}

TEST(LooseNodes, AreWhatBulletsConstructorMakes) {
  btSoftBodyWorldInfo info;
  const Grid nodes = grid(manyAlong);
  const auto body = wetcloth::looseNodes(info, nodes.positions, nodes.masses);
  const auto bullets = bulletsOwn(info, nodes);
  ASSERT_EQ(body->m_nodes.size(), bullets->m_nodes.size());
  ASSERT_EQ(body->m_X.size(), bullets->m_X.size());
  for (int i = 0; i < body->m_nodes.size(); ++i) {
    const btSoftBody::Node& a = body->m_nodes[i];
    const btSoftBody::Node& b = bullets->m_nodes[i];
    ASSERT_EQ(a.m_im, b.m_im) << i;
    ASSERT_TRUE(a.m_x == b.m_x && a.m_q == b.m_q && a.m_v == b.m_v && a.m_f == b.m_f && a.m_n == b.m_n) << i;
    ASSERT_TRUE(a.m_leaf->volume.Mins() == b.m_leaf->volume.Mins()) << i;
    ASSERT_TRUE(a.m_leaf->volume.Maxs() == b.m_leaf->volume.Maxs()) << i;
    ASSERT_EQ(a.m_material, body->m_materials[0]);
    ASSERT_EQ(a.m_battach, b.m_battach);
    ASSERT_TRUE(body->m_X[i] == bullets->m_X[i]);
  }
  EXPECT_EQ(body->m_materials.size(), bullets->m_materials.size());
  EXPECT_TRUE(body->m_bounds[0] == bullets->m_bounds[0] && body->m_bounds[1] == bullets->m_bounds[1]);
}

TEST(LooseNodes, OfFewNodesHaveBulletsOwnTree) {
  btSoftBodyWorldInfo info;
  const Grid nodes = grid(20);
  Tree ours, bullets;
  ours.look(wetcloth::looseNodes(info, nodes.positions, nodes.masses)->m_ndbvt.m_root);
  bullets.look(bulletsOwn(info, nodes)->m_ndbvt.m_root);
  EXPECT_EQ(ours.depth, bullets.depth);
}

TEST(LooseNodes, OfNoneAreABodyWithoutNodes) {
  btSoftBodyWorldInfo info;
  EXPECT_EQ(wetcloth::looseNodes(info, {})->m_nodes.size(), 0);
}

TEST(LooseNodes, RefuseWhatIsNoNode) {
  btSoftBodyWorldInfo info;
  const std::vector<btVector3> two = {btVector3(0, 0, 0), btVector3(1, 0, 0)};
  const auto complaint = [&](const std::vector<btVector3>& positions, const std::vector<btScalar>& masses) {
    return rejection([&] { wetcloth::looseNodes(info, positions, masses); });
  };
  EXPECT_EQ(complaint(two, {}), "");
  EXPECT_NE(complaint(two, {1}).find("masses.size() = 1"), std::string::npos) << complaint(two, {1});
  EXPECT_NE(complaint(two, {1, -1}).find("masses[1] = -1"), std::string::npos) << complaint(two, {1, -1});
  const btScalar infinity = std::numeric_limits<btScalar>::infinity();
  EXPECT_NE(complaint(two, {1, infinity}).find("masses[1] = inf"), std::string::npos) << complaint(two, {1, infinity});
  const btScalar none = std::numeric_limits<btScalar>::denorm_min();  // its inverse is infinite
  EXPECT_NE(complaint(two, {none, 1}).find("masses[0] = "), std::string::npos);
  EXPECT_EQ(complaint(two, {0, 1}), "") << "0 pins";
  const btVector3 nowhere(0, std::numeric_limits<btScalar>::quiet_NaN(), 0);
  EXPECT_NE(complaint({two[0], nowhere}, {}).find("positions[1] = not finite"), std::string::npos);
}

wetcloth::ClothPatch hangingPatch() {
  wetcloth::ClothPatch patch = squarePatch(130);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  return patch;
}

/// What Bullet's constructor would have made of the nodes' tree.
void makeTreeInOrder(btSoftBody& body) {
  body.m_ndbvt.clear();
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    btSoftBody::Node& node = body.m_nodes[i];
    node.m_leaf = body.m_ndbvt.insert(node.m_leaf->volume, &node);
  }
}

TEST_IN_EVERY_WORLD(LooseNodesInAWorld, MoveAsOnBulletsTreeWhereNothingTouchesThem) {
  BulletWorld ourWorld(GetParam()), bulletsWorld(GetParam());
  const auto ours = hangingPatch().build(ourWorld.info());
  const auto bullets = hangingPatch().build(bulletsWorld.info());
  for (btSoftBody* body : {ours.get(), bullets.get()}) body->m_cfg.collisions = 0;
  makeTreeInOrder(*bullets);
  ourWorld.add(*ours);
  bulletsWorld.add(*bullets);
  ourWorld.step(3);
  bulletsWorld.step(3);
  EXPECT_TRUE(sameBits(stateOf(*ours), stateOf(*bullets)));
  Tree tree;
  tree.look(ours->m_ndbvt.m_root);
  EXPECT_EQ(static_cast<int>(tree.leaves.size()), ours->m_nodes.size());
  ourWorld.remove(*ours);
  bulletsWorld.remove(*bullets);
}

TEST(LooseNodesState, GoesOnAfterARestoreAsWithoutOne) {
  const auto fall = [](bool isRestored) {
    BodyScene scene(WorldKind::softRigid, hangingPatch());
    wetcloth::WetClothWorld wet(scene.world());
    wet.add(scene.body());
    scene.bullet().step(2, btScalar(1) / 30);
    std::stringstream saved;
    wet.save(saved);
    if (isRestored) {
      scene.bullet().step(4, btScalar(1) / 30);
      wet.restore(saved);
    }
    scene.bullet().step(4, btScalar(1) / 30);
    return stateOf(scene.body());
  };
  EXPECT_TRUE(sameBits(fall(true), fall(false)));
}

}  // namespace
}  // namespace wetcloth_test::loose_nodes_test
