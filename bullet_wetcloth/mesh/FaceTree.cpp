// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/mesh/FaceTree.h"

#include "bullet_wetcloth/mesh/HalvedTree.h"

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

btDbvtNode* newLeaf(btSoftBody::Face& face) {
  btVector3 low = face.m_n[0]->m_x;
  btVector3 high = low;
  for (const btSoftBody::Node* node : face.m_n) {
    low.setMin(node->m_x);
    high.setMax(node->m_x);
  }
  face.m_leaf = newTreeNode(btDbvtVolume::FromMM(low, high), &face);
  return face.m_leaf;
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
  std::vector<btDbvtNode*> leaves;
  for (int f = 0; f < body.m_faces.size(); ++f) leaves.push_back(newLeaf(body.m_faces[f]));
  if (leaves.empty()) return;
  fillTree(body.m_fdbvt, leaves);
  body.m_fdbvnt = withNormals(*body.m_fdbvt.m_root);
  body.updateFaceTree(false, false);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
