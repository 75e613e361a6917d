// SPDX-License-Identifier: Zlib
#include "command/scene/ClothBody.h"

#include "command/scene/MeshBody.h"

#include <cstddef>

namespace command {
namespace {

std::unique_ptr<btSoftBody> bodyOf(const ClothScene& cloth, btSoftBodyWorldInfo& worldInfo) {
  if (const auto* patch = std::get_if<wetcloth::ClothPatch>(&cloth.shape)) return patch->build(worldInfo);
  auto body = makeMeshBody(std::get<TriangleMesh>(cloth.shape), cloth.fabric.arealDensity, worldInfo);
  // Not by setMass(), after which Bullet takes the links' lengths anew.
  for (const int node : cloth.pinnedNodes) body->m_nodes[node].m_im = 0;
  body->updateLinkConstants();
  return body;
}

}  // namespace

std::unique_ptr<btSoftBody> makeClothBody(const ClothScene& cloth, btSoftBodyWorldInfo& worldInfo) {
  std::unique_ptr<btSoftBody> body = bodyOf(cloth, worldInfo);
  body->m_cfg.kDF = btScalar(cloth.friction);
  body->m_cfg.kDP = btScalar(cloth.damping);
  body->getCollisionShape()->setMargin(btScalar(cloth.margin));
  if (cloth.clusters > 0) body->generateClusters(cloth.clusters);
  body->setSelfCollision(cloth.selfCollision);
  if (cloth.meetsWhatMoves) body->m_cfg.kKHR = 1;
  return body;
}

void placeNodes(btSoftBody& body, const std::vector<btVector3>& places) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    btSoftBody::Node& node = body.m_nodes[static_cast<int>(i)];
    node.m_x = node.m_q = places[i];
  }
  body.updateBounds();
}

}  // namespace command
