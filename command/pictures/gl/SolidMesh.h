// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/gl/VertexArray.h"

#include "command/pictures/FrameSequence.h"

#include <vector>

namespace pictures {

/// A solid's triangles, drawn once or at many places.
class SolidMesh {
 public:
  explicit SolidMesh(const Solid& solid);

  /// The same triangles at other places.
  void update(const Solid& solid);
  void draw() const;
  /// @param instances  four numbers each: moved to x, y, z and made so many times as large
  void drawAt(const std::vector<float>& instances);

 private:
  VertexArray m_vertices;
};

/// Of radius 1 about the origin.
Solid roundBall();

/// A round bar with closed ends.
Solid roundBar(const Vector3& from, const Vector3& to, float radius);

}  // namespace pictures
