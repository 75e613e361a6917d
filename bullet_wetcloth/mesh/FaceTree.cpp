// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/mesh/FaceTree.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Bullet frees nodes with btAlignedFree().
btDbvtNode* newNode(const btDbvtVolume& volume) {
  auto* const node = new (btAlignedAlloc(sizeof(btDbvtNode), 16)) btDbvtNode();
  node->parent = nullptr;
  node->childs[0] = node->childs[1] = nullptr;
  node->volume = volume;
  return node;
}

btDbvtNode* newLeaf(btSoftBody::Face& face) {
  btVector3 low = face.m_n[0]->m_x;
  btVector3 high = low;
  for (const btSoftBody::Node* node : face.m_n) {
    low.setMin(node->m_x);
    high.setMax(node->m_x);
  }
  btDbvtNode* const leaf = newNode(btDbvtVolume::FromMM(low, high));
  leaf->data = &face;
  face.m_leaf = leaf;
  return leaf;
}

using Leaves = std::vector<btDbvtNode*>;

// Halves them where their box is longest, until one is left.
btDbvtNode* treeOf(Leaves::iterator first, Leaves::iterator last) {
  if (last - first == 1) return *first;
  btDbvtVolume box = (*first)->volume;
  for (auto leaf = first; leaf != last; ++leaf) Merge(box, (*leaf)->volume, box);
  const int axis = box.Lengths().maxAxis();
  const auto middle = first + (last - first) / 2;
  std::nth_element(first, middle, last, [axis](const btDbvtNode* a, const btDbvtNode* b) {
    return a->volume.Center()[axis] < b->volume.Center()[axis];
  });
  btDbvtNode* const node = newNode(box);
  node->childs[0] = treeOf(first, middle);
  node->childs[1] = treeOf(middle, last);
  node->childs[0]->parent = node->childs[1]->parent = node;
  return node;
}

btDbvntNode* withNormals(const btDbvtNode& node) {
  auto* const copy = new btDbvntNode(&node);
  if (node.isleaf()) return copy;
  for (int i = 0; i < 2; ++i) copy->childs[i] = withNormals(*node.childs[i]);
  return copy;
}

}  // namespace

void buildFaceTree(btSoftBody& body) {
  if (body.m_bUpdateRtCst) body.updateConstants();
  body.m_bUpdateRtCst = false;  // or the first step would clear the tree and let Bullet make its own
  body.m_fdbvt.clear();
  delete body.m_fdbvnt;
  body.m_fdbvnt = nullptr;
  Leaves leaves;
  for (int f = 0; f < body.m_faces.size(); ++f) leaves.push_back(newLeaf(body.m_faces[f]));
  if (leaves.empty()) return;
  body.m_fdbvt.m_root = treeOf(leaves.begin(), leaves.end());
  body.m_fdbvt.m_leaves = body.m_faces.size();
  body.m_fdbvnt = withNormals(*body.m_fdbvt.m_root);
  body.updateFaceTree(false, false);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
