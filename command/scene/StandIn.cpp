// SPDX-License-Identifier: Zlib
#include "command/scene/StandIn.h"

#include <algorithm>

namespace command {
namespace {

constexpr int mostNodesAlong = 4;

/// The edge with as long a piece from node to node.
btVector3 shortened(const btVector3& edge, int nodes, int fewer) {
  return edge * (btScalar(fewer - 1) / btScalar(nodes - 1));
}

void makeSmall(wetcloth::ClothPatch& patch) {
  const int columns = std::min(patch.columns, mostNodesAlong);
  const int rows = std::min(patch.rows, mostNodesAlong);
  patch.edgeU = shortened(patch.edgeU, patch.columns, columns);
  patch.edgeV = shortened(patch.edgeV, patch.rows, rows);
  patch.columns = columns;
  patch.rows = rows;
  patch.pinnedNodes.clear();
}

}  // namespace

Scene standIn(const Scene& scene) {
  Scene small = scene;
  for (ClothScene& cloth : small.cloths) {
    if (auto* const patch = std::get_if<wetcloth::ClothPatch>(&cloth.shape)) makeSmall(*patch);
    cloth.clusters = std::min(cloth.clusters, cloth.nodeCount());
  }
  return small;
}

}  // namespace command
