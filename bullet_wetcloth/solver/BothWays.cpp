// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/BothWays.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/mesh/RestMesh.h"

#include <algorithm>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// A triangulation has up to 3 edges a node, and with one bending link across each edge up to 6. What has no more links
// than nodes is a rope.
bool hasOnlyEdges(const btSoftBody& body) {
  constexpr double kMostLinksPerNode = 3.5;
  const int links = body.m_links.size();
  const int nodes = body.m_nodes.size();
  return links > nodes && links < kMostLinksPerNode * nodes;
}

// By the law of cosines, of the sides at rest: it does not matter how the cloth lies now.
bool isObtuse(const RestMesh::Triangle& triangle, const RestMesh& mesh) {
  constexpr double kCosineOf150Degrees = -0.866;
  double side[3];
  for (std::size_t k = 0; k < 3; ++k) {
    if (triangle.edges[k] < 0) return false;
    side[k] = mesh.edges()[toSize(triangle.edges[k])].length;
  }
  std::sort(side, side + 3);
  return side[0] * side[0] + side[1] * side[1] - side[2] * side[2] < kCosineOf150Degrees * 2 * side[0] * side[1];
}

// A few, as in any irregular mesh, do no harm: up to a quarter of all was tried.
bool hasManyObtuseTriangles(const btSoftBody& body) {
  constexpr std::size_t kOneIn = 10;
  const RestMesh mesh(body);
  std::size_t count = 0;
  for (const RestMesh::Triangle& triangle : mesh.triangles()) {
    if (isObtuse(triangle, mesh)) ++count;
  }
  return kOneIn * count > mesh.triangles().size();
}

}  // namespace

bool needsBothWays(const btSoftBody& body) { return hasOnlyEdges(body) || hasManyObtuseTriangles(body); }

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
