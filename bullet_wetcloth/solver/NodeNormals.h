// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/numerics/TriangleBlocks.h"
#include "bullet_wetcloth/solver/LocalNodes.h"

#include <BulletSoftBody/btSoftBody.h>

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Normals of a body's faces, and of its nodes: the sum of those of their faces by area, as
/// btSoftBody::updateNormals() has them.
class NodeNormals {
 public:
  using Lane = LocalNodes::Lane;

  /// For the faces of this body, whose nodes stand in these slots.
  void reset(const btSoftBody& body, const NodeSlots& slots);
  /// Of the nodes, from their places.
  void compute(const MovingNodes& nodes);
  /// Those of the faces, into the body.
  void writeFaces(btSoftBody& body, const MovingNodes& nodes) const;
  /// One number for each slot: of length 1, or 0 where no face has an area.
  const Lane (&lanes() const)[3] { return m_normal; }

 private:
  struct Kernel;

  TriangleBlocks m_triangles;
  std::vector<TriangleBlocks::Triangle> m_faces;  // slots, in the order of the body's faces
  Lane m_normal[3];
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
