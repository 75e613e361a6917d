// SPDX-License-Identifier: Zlib
#include "command/pictures/gl/ClothMesh.h"

#include "command/pictures/VectorMath.h"

#include <cstddef>

namespace pictures {
namespace {

constexpr std::size_t movingBuffer = 0;
constexpr std::size_t textureBuffer = 1;

std::size_t at(int index) { return static_cast<std::size_t>(index); }

}  // namespace

ClothMesh::ClothMesh(const ClothShape& shape) : m_triangles(shape.triangles) {
  m_vertices.addBuffer(0, {3, 3, 2});
  m_vertices.addBuffer(3, {2});
  m_vertices.setTriangles(m_triangles);
  std::vector<float> texture;
  for (const Texture& place : shape.texture) texture.insert(texture.end(), place.begin(), place.end());
  m_vertices.upload(textureBuffer, texture);
}

/// Each node's is averaged with its neighbours': the triangles' own show every wrinkle of the mesh.
void ClothMesh::findNormals(const std::vector<Vector3>& positions) {
  m_rough.assign(positions.size(), {0, 0, 0});
  for (const auto& [a, b, c] : m_triangles) {
    const Vector3 normal = cross(positions[at(b)] - positions[at(a)], positions[at(c)] - positions[at(a)]);
    for (const int corner : {a, b, c}) m_rough[at(corner)] = m_rough[at(corner)] + normal;
  }
  for (Vector3& normal : m_rough) normal = unit(normal);
  m_normals.assign(positions.size(), {0, 0, 0});
  for (const auto& [a, b, c] : m_triangles) {
    const Vector3 sum = m_rough[at(a)] + m_rough[at(b)] + m_rough[at(c)];
    for (const int corner : {a, b, c}) m_normals[at(corner)] = m_normals[at(corner)] + sum;
  }
  for (Vector3& normal : m_normals) normal = unit(normal);
}

void ClothMesh::update(const ClothState& state, const std::vector<float>& values) {
  findNormals(state.positions);
  m_upload.clear();
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    m_upload.insert(m_upload.end(), state.positions[i].begin(), state.positions[i].end());
    m_upload.insert(m_upload.end(), m_normals[i].begin(), m_normals[i].end());
    m_upload.push_back(state.saturation[i]);
    m_upload.push_back(values.empty() ? 0 : values[i]);
  }
  m_vertices.upload(movingBuffer, m_upload);
}

}  // namespace pictures
