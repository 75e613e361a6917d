// SPDX-License-Identifier: Zlib
// Bullet's tree of faces for cloth in several parts, where its own initializeFaceTree() never returns.

#include "bullet_wetcloth/mesh/FaceTree.h"
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "bullet_wetcloth/mesh/ClothPatch.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/SoftBodies.h"

#include <cmath>
#include <memory>
#include <set>
#include <utility>

namespace wetcloth_test::face_tree_test {
namespace {

/// Two triangles in a row and a third apart from them; above `height`.
std::unique_ptr<btSoftBody> twoParts(btSoftBodyWorldInfo& info, btScalar height) {
  const btVector3 nodes[] = {btVector3(0, height, 0), btVector3(1, height, 0), btVector3(0, height, 1),
                             btVector3(1, height, 1), btVector3(3, height, 0), btVector3(4, height, 0),
                             btVector3(3, height, 1)};
  const btScalar masses[] = {1, 1, 1, 1, 1, 1, 1};
  auto body = std::make_unique<btSoftBody>(&info, 7, nodes, masses);
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}, {1, 3}, {3, 2}, {4, 5}, {5, 6}, {6, 4}}) {
    body->appendLink(a, b);
  }
  body->appendFace(0, 1, 2);
  body->appendFace(1, 3, 2);
  body->appendFace(4, 5, 6);
  return body;
}

void collect(const btDbvtNode* node, std::set<void*>& leaves) {
  if (node->isleaf()) {
    leaves.insert(node->data);
    return;
  }
  for (const btDbvtNode* child : node->childs) {
    EXPECT_EQ(child->parent, node);
    EXPECT_TRUE(node->volume.Contain(child->volume));
    collect(child, leaves);
  }
}

TEST(FaceTree, HasEveryFaceOnce) {
  btSoftBodyWorldInfo info;
  wetcloth::ClothPatch patch;
  const auto body = patch.build(info);
  wetcloth::buildFaceTree(*body);
  std::set<void*> leaves;
  collect(body->m_fdbvt.m_root, leaves);
  EXPECT_EQ(int(leaves.size()), body->m_faces.size());
  ASSERT_NE(body->m_fdbvnt, nullptr);
  wetcloth::buildFaceTree(*body);  // again, and nothing leaks
  EXPECT_EQ(body->m_fdbvt.m_root->parent, nullptr);
}

TEST_IN_EVERY_WORLD(FaceTreeTest, ClothInTwoPartsRunsAndCollides) {
  BulletWorld world(GetParam());
  auto below = twoParts(world.info(), 0);
  auto above = twoParts(world.info(), btScalar(0.1));
  for (btSoftBody* body : {below.get(), above.get()}) {
    using Flag = btSoftBody::fCollision;
    body->m_cfg.collisions =
        world.isDeformable() ? Flag::SDF_RD | Flag::SDF_RDF | Flag::VF_DD : Flag::SDF_RS | Flag::VF_SS;
    body->setSelfCollision(true);
  }
  for (int i = 0; i < below->m_nodes.size(); ++i) below->setMass(i, 0);
  for (btSoftBody* body : {below.get(), above.get()}) {
    wetcloth::buildFaceTree(*body);
    world.add(*body);
  }
  world.step(240);
  for (int i = 0; i < above->m_nodes.size(); ++i) {
    const btVector3& place = above->m_nodes[i].m_x;
    EXPECT_TRUE(std::isfinite(place.length2()));
    if (world.isDeformable()) continue;
    EXPECT_GT(place.y(), -1) << i;  // 4.9 m lower if nothing held it
  }
  for (btSoftBody* body : {below.get(), above.get()}) world.remove(*body);
}

// The flag by which Bullet makes the tree in the next step.
int treeFlags(const BulletWorld& world) {
  using Flag = btSoftBody::fCollision;
  return world.isDeformable() ? Flag::SDF_RD | Flag::SDF_RDN : Flag::SDF_RS | Flag::VF_SS;
}

std::unique_ptr<btSoftBody> withoutLinks(btSoftBodyWorldInfo& info) {
  return triangles({btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 0, 1)}, {1, 1, 1}, {{0, 1, 2}})(info);
}

// A step that Bullet does not come back from would hang the test: so the tree is looked for before.
TEST_IN_EVERY_WORLD(FaceTreeTest, AClothThatBulletHangsOnGetsOneInItsFirstStep) {
  for (const bool hasLinks : {true, false}) {
    BulletWorld world(GetParam());
    const auto body = hasLinks ? twoParts(world.info(), 0) : withoutLinks(world.info());
    world.add(*body);
    {
      wetcloth::WetClothWorld wet(world.world());
      wet.add(*body).add<wetcloth::Absorption>();
      body->m_cfg.collisions = treeFlags(world);                // later than add()
      for (const btScalar mass : {btScalar(7), btScalar(9)}) {  // before the first step, and while it runs
        body->setTotalMass(mass);
        wet.preTick(btScalar(1) / 240);
        ASSERT_FALSE(body->m_bUpdateRtCst);
        ASSERT_NE(body->m_fdbvnt, nullptr);
        world.step(20);
      }
      for (int i = 0; i < body->m_nodes.size(); ++i) EXPECT_TRUE(std::isfinite(body->m_nodes[i].m_x.length2()));
    }
    world.remove(*body);
  }
}

TEST_IN_EVERY_WORLD(FaceTreeTest, WhatBulletDoesByItselfIsLeftToIt) {
  BulletWorld world(GetParam());
  const auto whole = squarePatch(4).build(world.info());
  const auto withoutFlag = twoParts(world.info(), 5);
  whole->m_cfg.collisions = treeFlags(world);
  withoutFlag->m_cfg.collisions = btSoftBody::fCollision::SDF_RS;
  for (btSoftBody* body : {whole.get(), withoutFlag.get()}) {
    body->setTotalMass(7);
    world.add(*body);
  }
  {
    wetcloth::WetClothWorld wet(world.world());
    for (btSoftBody* body : {whole.get(), withoutFlag.get()}) {
      wet.add(*body).add<wetcloth::Absorption>();
      wet.preTick(btScalar(1) / 240);
      EXPECT_TRUE(body->m_bUpdateRtCst);
      EXPECT_EQ(body->m_fdbvnt, nullptr);
    }
  }
  for (btSoftBody* body : {whole.get(), withoutFlag.get()}) world.remove(*body);
}

}  // namespace
}  // namespace wetcloth_test::face_tree_test
