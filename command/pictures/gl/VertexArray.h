// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <epoxy/gl.h>

#include <cstddef>
#include <vector>

namespace pictures {

/// Vertices on the graphics card, and triangles of them.
class VertexArray {
 public:
  VertexArray();
  ~VertexArray();
  VertexArray(const VertexArray&) = delete;
  VertexArray& operator=(const VertexArray&) = delete;

  enum class Step { vertex, instance };

  /// Adds a buffer whose floats are dealt out to shader inputs: so many each, at `location` and on from there.
  /// @return its number, for upload()
  std::size_t addBuffer(GLuint location, const std::vector<int>& componentsOfInputs, Step step = Step::vertex);
  void upload(std::size_t buffer, const std::vector<float>& values);
  void setTriangles(const std::vector<Triangle>& triangles);

  void draw() const;
  /// Some of its triangles.
  void draw(std::size_t first, std::size_t count) const;
  void drawInstances(std::size_t count) const;
  /// The first `count` vertices, three for each triangle.
  void drawVertices(std::size_t count) const;

 private:
  GLuint m_array = 0;
  std::vector<GLuint> m_buffers;
  GLuint m_indices = 0;
  GLsizei m_indexCount = 0;
};

}  // namespace pictures
