// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/gl/VertexArray.h"

#include "command/pictures/FrameSequence.h"

#include <cstddef>
#include <vector>

namespace pictures {

/// A cloth's triangles with smooth normals.
class ClothMesh {
 public:
  explicit ClothMesh(const ClothShape& shape);

  /// @param values  one per node: what is coloured by, [0, 1]; empty: nothing
  void update(const ClothState& state, const std::vector<float>& values);
  void draw() const { m_vertices.draw(); }
  /// Some of its triangles.
  void draw(std::size_t first, std::size_t count) const { m_vertices.draw(first, count); }

 private:
  void findNormals(const std::vector<Vector3>& positions);

  std::vector<Triangle> m_triangles;
  VertexArray m_vertices;
  std::vector<Vector3> m_rough;
  std::vector<Vector3> m_normals;
  std::vector<float> m_upload;
};

}  // namespace pictures
