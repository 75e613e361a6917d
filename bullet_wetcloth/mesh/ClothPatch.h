// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

#include <array>
#include <memory>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A rectangular patch of cloth with exactly the paper's springs (Basori et al. 2017, III.A): mechanical
/// (i,j)-(i+1,j) and (i,j)-(i,j+1); shear on both diagonals; flexion (i,j)-(i+2,j) and (i,j)-(i,j+2).
/// 5826 springs at 32 x 32.
///
/// Node (i, j), 0 <= i < columns, 0 <= j < rows, has index j * columns + i and lies at
/// origin + edgeU i / (columns - 1) + edgeV j / (rows - 1).
struct WETCLOTH_EXPORT ClothPatch {
  /// Where nodes can be pinned: i = 0, i = columns - 1, j = 0, j = rows - 1.
  enum class Edge { left, right, bottom, top };
  /// Where two edges meet.
  enum class Corner { bottomLeft, bottomRight, topLeft, topRight };
  /// To the next node along an edge; across a square; to the next but one along an edge.
  enum class Spring { mechanical, shear, flexion };

  int columns = 32;                       ///< >= 2
  int rows = 32;                          ///< >= 2
  btVector3 origin = btVector3(0, 0, 0);  ///< [m]
  btVector3 edgeU = btVector3(1, 0, 0);   ///< along a row [m], not parallel to edgeV
  btVector3 edgeV = btVector3(0, 0, 1);   ///< along a column [m]
  double arealDensity = 0.150;            ///< [kg/m^2], (0, inf); a node's mass is a third of its triangles'

  /// Bullet's position-based link stiffness (btSoftBody::Material::m_kLST) by kind, (0, 1].
  double mechanicalStiffness = 1;
  double shearStiffness = 1;    ///< (0, 1]
  double flexionStiffness = 1;  ///< (0, 1]

  std::vector<Corner> pinnedCorners = {};  ///< a node each
  std::vector<Edge> pinnedEdges = {};      ///< all their nodes
  std::vector<int> pinnedNodes = {};       ///< indices in [0, columns * rows)

  /// Columns times rows.
  int nodeCount() const { return columns * rows; }
  /// Index of the node in column i, [0, columns), and row j, [0, rows).
  int node(int i, int j) const { return j * columns + i; }
  /// Number of springs of a kind.
  long long springCount(Spring kind) const;

  /// Makes the soft body; add it to your world and keep it. Works in all three of Bullet's worlds. Links are in an
  /// order that keeps neighbours in the list apart in the mesh, which halves Bullet's time per link; m_materials
  /// holds the three kinds in the order of Spring, flexion links are marked as bending. Set collision flags and
  /// iterations as for any body. Throws std::invalid_argument naming the field and the value.
  std::unique_ptr<btSoftBody> build(btSoftBodyWorldInfo& worldInfo) const;

  /// Texture coordinates (u, v) in [0, 1], one pair per node. Throws std::invalid_argument naming `columns` or `rows`.
  std::vector<std::array<float, 2>> textureCoordinates() const;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
