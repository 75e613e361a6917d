// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/mesh/FaceWinding.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/mesh/RestMesh.h"

#include <array>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

struct TrianglesAtEdge {
  int count = 0;  // of triangles
  std::array<int, 2> triangles = {-1, -1};
};

std::vector<TrianglesAtEdge> trianglesAtEdges(const RestMesh& mesh) {
  std::vector<TrianglesAtEdge> atEdges(mesh.edges().size());
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    if (!(mesh.triangles()[t].area > 0)) continue;
    for (const int edge : mesh.triangles()[t].edges) {
      TrianglesAtEdge& here = atEdges[toSize(edge)];
      if (here.count < 2) here.triangles[toSize(here.count)] = static_cast<int>(t);
      ++here.count;
    }
  }
  return atEdges;
}

/// Whether the triangle goes along this edge of its from the lower node to the higher one.
bool goesUp(const RestMesh::Triangle& triangle, int edge) {
  std::size_t k = 0;
  while (triangle.edges[k] != edge) ++k;
  return triangle.nodes[(k + 1) % 3] < triangle.nodes[(k + 2) % 3];
}

/// Gives the neighbours of a triangle that have no sign yet theirs, and adds them to `open`.
void wind(const RestMesh& mesh, const std::vector<TrianglesAtEdge>& atEdges, int here, std::vector<int>& windings,
          std::vector<int>& open) {
  const RestMesh::Triangle& triangle = mesh.triangles()[toSize(here)];
  for (const int edge : triangle.edges) {
    const TrianglesAtEdge& both = atEdges[toSize(edge)];
    if (both.count != 2) continue;
    const int there = both.triangles[0] == here ? both.triangles[1] : both.triangles[0];
    if (windings[toSize(there)] != 0) continue;
    // Two triangles that go round the same way go along their edge in opposite directions.
    const bool isAlike = goesUp(triangle, edge) != goesUp(mesh.triangles()[toSize(there)], edge);
    windings[toSize(there)] = isAlike ? windings[toSize(here)] : -windings[toSize(here)];
    open.push_back(there);
  }
}

}  // namespace

std::vector<int> faceWindings(const RestMesh& mesh) {
  const std::vector<TrianglesAtEdge> atEdges = trianglesAtEdges(mesh);
  std::vector<int> windings(mesh.triangles().size(), 0);
  std::vector<int> open;
  for (std::size_t first = 0; first < windings.size(); ++first) {
    if (windings[first] != 0 || !(mesh.triangles()[first].area > 0)) continue;
    windings[first] = 1;
    open.push_back(static_cast<int>(first));
    while (!open.empty()) {
      const int here = open.back();
      open.pop_back();
      wind(mesh, atEdges, here, windings, open);
    }
  }
  return windings;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
