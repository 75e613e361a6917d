// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/BodyPose.h"
#include "bullet_wetcloth/solver/GuardMesh.h"
#include "bullet_wetcloth/solver/ShapeFaces.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Faces of rigid bodies as a mesh that a guard takes: a cell is a face with what no face before it has.
class BodyMesh {
 public:
  BodyMesh() { m_mesh.isOfBodies = true; }
  void clear();
  /// Of one body, which goes from one pose to the other.
  void add(const ShapeFaces& shape, const BodyPose& from, const BodyPose& to);
  /// After the last one.
  void finish();

  const GuardMesh& mesh() const { return m_mesh; }
  std::size_t nodes() const { return m_from.size(); }
  const std::vector<BodyPoint>& from() const { return m_from; }
  const std::vector<BodyPoint>& to() const { return m_to; }

 private:
  struct Side {
    int low;
    int high;
    int face;
    int before;  // of m_sides, with the same low corner
  };
  void findEdges(const ShapeFaces& shape);

  GuardMesh m_mesh;
  std::vector<BodyPoint> m_from;  // of each node
  std::vector<BodyPoint> m_to;
  std::vector<char> m_hasVertex;
  std::vector<Side> m_sides;
  std::vector<int> m_lastSide;  // of each corner, as the low one
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
