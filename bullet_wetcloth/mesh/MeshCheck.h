// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

#include <array>
#include <string>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What a cloth's mesh is like, and what of it is rarely meant. Nodes and faces have the numbers that they were given.
struct WETCLOTH_EXPORT MeshReport {
  /// Nodes nearer than this are in one place, as a share of the mesh's size: what text and float32 round to.
  static constexpr double toleranceOfSize = 1e-6;

  int nodes = 0;                     ///< in number
  int faces = 0;                     ///< in number
  double size = 0;                   ///< diagonal of the box round all nodes [m]
  double tolerance = 0;              ///< toleranceOfSize * size [m]
  std::vector<int> firstAt;          ///< of each node: the first node in its place, itself where it is alone
  int coincidentNodes = 0;           ///< that are not the first in their place
  std::vector<int> strayNodes;       ///< of no face and no link
  std::vector<int> degenerateFaces;  ///< a corner twice, or no area
  std::vector<int> doubledFaces;     ///< with the three nodes of an earlier face, either way round
  std::vector<std::array<int, 2>> nonManifoldEdges;  ///< of more than two faces, doubled ones not counted; a < b
  int parts = 0;                                     ///< that no shared node and no link joins; stray nodes are none
  int facePieces = 0;  ///< sets of faces that hang together by edges: a bow tie is one part of two pieces
  int nodePieces =
      0;  ///< sets of nodes that hang together by a body's links; stray nodes are one each; 0 without a body

  /// Whether btSoftBody::initializeFaceTree() comes to an end: Bullet 3.24 pairs neighbours until one is left, which
  /// never happens where not all faces hang together by edges and all nodes by links. It is called in the deformable
  /// world with SDF_RD, elsewhere with VF_SS, and by rayTest(); see buildFaceTree(). A WetClothWorld sees to its
  /// cloths.
  bool bulletBuildsFaceTree() const { return facePieces <= 1 && nodePieces <= 1; }

  /// "2 parts that nothing joins; 3 coincident nodes": empty where there is nothing to tell.
  std::string summary() const;
};

/// Checks nodes at `positions` [m] with `triangles` of node numbers in [0, positions.size()). O(n log n).
WETCLOTH_EXPORT MeshReport checkMesh(const std::vector<btVector3>& positions,
                                     const std::vector<std::array<int, 3>>& triangles);

/// The same of a body as it is now, with its links.
WETCLOTH_EXPORT MeshReport checkMesh(const btSoftBody& body);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
