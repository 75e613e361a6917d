// SPDX-License-Identifier: Zlib
#include "command/pictures/VertexNormals.h"

#include "command/pictures/VectorMath.h"

#include <cstddef>

namespace pictures {

std::vector<Vector3> vertexNormals(const std::vector<Vector3>& vertices, const std::vector<Triangle>& triangles) {
  std::vector<Vector3> normals(vertices.size(), Vector3{});
  for (const Triangle& triangle : triangles) {
    const auto corner = [&](std::size_t i) { return static_cast<std::size_t>(triangle[i]); };
    const Vector3& first = vertices[corner(0)];
    const Vector3 across = cross(vertices[corner(1)] - first, vertices[corner(2)] - first);
    for (std::size_t i = 0; i < 3; ++i) normals[corner(i)] = normals[corner(i)] + across;
  }
  for (Vector3& normal : normals) normal = unit(normal);
  return normals;
}

}  // namespace pictures
