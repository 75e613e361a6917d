// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/mesh/LooseNodes.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/mesh/HalvedTree.h"

#include <cmath>
#include <cstddef>
#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

void requireValid(const std::vector<btVector3>& positions, const std::vector<btScalar>& masses) {
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!isFinite(positions[i])) rejectValue("positions[" + std::to_string(i) + "]", "not finite", "finite");
  }
  if (!masses.empty() && masses.size() != positions.size()) {
    rejectValue("masses.size()", masses.size(), "0, or one for each of " + std::to_string(positions.size()) + " nodes");
  }
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const bool isMass = masses[i] > 0 && std::isfinite(masses[i]) && std::isfinite(1 / masses[i]);
    if (isMass || masses[i] == 0) continue;
    rejectValue("masses[" + std::to_string(i) + "]", static_cast<double>(masses[i]),
                "0, or > 0 and finite, as its inverse must be");
  }
}

// All but their tree.
void addNodes(btSoftBody& body, const std::vector<btVector3>& positions, const std::vector<btScalar>& masses) {
  const int count = static_cast<int>(positions.size());
  const btSoftBody::Node first = body.m_nodes[0];  // what else Bullet's constructor writes into a node
  body.m_nodes.resize(count, first);
  body.m_X.resize(count);
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    btSoftBody::Node& node = body.m_nodes[i];
    node.m_x = node.m_q = body.m_X[i] = positions[k];
    const btScalar mass = masses.empty() ? 1 : masses[k];
    node.m_im = mass > 0 ? 1 / mass : 0;
  }
}

void buildNodeTree(btSoftBody& body) {
  body.m_ndbvt.clear();
  const btScalar margin = body.getCollisionShape()->getMargin();
  std::vector<btDbvtNode*> leaves;
  leaves.reserve(static_cast<std::size_t>(body.m_nodes.size()));
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    btSoftBody::Node& node = body.m_nodes[i];
    node.m_leaf = newTreeNode(btDbvtVolume::FromCR(node.m_x, margin), &node);
    leaves.push_back(node.m_leaf);
  }
  fillTree(body.m_ndbvt, leaves);
}

}  // namespace

std::unique_ptr<btSoftBody> looseNodes(btSoftBodyWorldInfo& worldInfo, const std::vector<btVector3>& positions,
                                       const std::vector<btScalar>& masses) {
  requireValid(positions, masses);
  const int count = static_cast<int>(positions.size());
  const bool isForBullet = count <= mostNodesForBullet;
  auto body = std::make_unique<btSoftBody>(&worldInfo, isForBullet ? count : 1, positions.data(),
                                           masses.empty() ? nullptr : masses.data());
  if (isForBullet) return body;
  addNodes(*body, positions, masses);
  buildNodeTree(*body);
  body->updateBounds();
  return body;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
