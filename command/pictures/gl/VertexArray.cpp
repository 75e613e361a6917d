// SPDX-License-Identifier: Zlib
#include "command/pictures/gl/VertexArray.h"

#include <numeric>

namespace pictures {

VertexArray::VertexArray() { glGenVertexArrays(1, &m_array); }

VertexArray::~VertexArray() {
  glDeleteVertexArrays(1, &m_array);
  glDeleteBuffers(static_cast<GLsizei>(m_buffers.size()), m_buffers.data());
  glDeleteBuffers(1, &m_indices);
}

std::size_t VertexArray::addBuffer(GLuint location, const std::vector<int>& componentsOfInputs, Step step) {
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  m_buffers.push_back(buffer);
  glBindVertexArray(m_array);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  const int all = std::accumulate(componentsOfInputs.begin(), componentsOfInputs.end(), 0);
  std::size_t offset = 0;
  for (const int components : componentsOfInputs) {
    glEnableVertexAttribArray(location);
    // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL takes offsets as pointers
    const auto* const start = reinterpret_cast<const void*>(offset * sizeof(float));
    glVertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, all * static_cast<GLsizei>(sizeof(float)), start);
    glVertexAttribDivisor(location, step == Step::instance ? 1 : 0);
    offset += static_cast<std::size_t>(components);
    ++location;
  }
  glBindVertexArray(0);
  return m_buffers.size() - 1;
}

void VertexArray::upload(std::size_t buffer, const std::vector<float>& values) {
  glBindBuffer(GL_ARRAY_BUFFER, m_buffers[buffer]);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(values.size() * sizeof(float)), values.data(), GL_DYNAMIC_DRAW);
}

void VertexArray::setTriangles(const std::vector<Triangle>& triangles) {
  if (m_indices == 0) glGenBuffers(1, &m_indices);
  m_indexCount = static_cast<GLsizei>(3 * triangles.size());
  glBindVertexArray(m_array);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, m_indices);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles.size() * sizeof(Triangle)), triangles.data(),
               GL_STATIC_DRAW);
  glBindVertexArray(0);
}

void VertexArray::draw() const { draw(0, static_cast<std::size_t>(m_indexCount) / 3); }

void VertexArray::draw(std::size_t first, std::size_t count) const {
  glBindVertexArray(m_array);
  // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL takes offsets as pointers
  const auto* const start = reinterpret_cast<const void*>(first * sizeof(Triangle));
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * count), GL_UNSIGNED_INT, start);
}

void VertexArray::drawInstances(std::size_t count) const {
  glBindVertexArray(m_array);
  glDrawElementsInstanced(GL_TRIANGLES, m_indexCount, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(count));
}

void VertexArray::drawVertices(std::size_t count) const {
  glBindVertexArray(m_array);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(count));
}

}  // namespace pictures
