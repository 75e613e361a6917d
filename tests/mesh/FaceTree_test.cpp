// SPDX-License-Identifier: Zlib
// Bullet's tree of faces for cloth in several parts, where its own initializeFaceTree() never returns.

#include "bullet_wetcloth/mesh/FaceTree.h"
#include "bullet_wetcloth/mesh/ClothPatch.h"
#include "tests/support/BulletWorld.h"

#include <set>

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

class FaceTreeTest : public InEveryWorld {};

TEST_P(FaceTreeTest, ClothInTwoPartsRunsAndCollides) {
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

WETCLOTH_IN_EVERY_WORLD(FaceTreeTest);

}  // namespace
}  // namespace wetcloth_test::face_tree_test
