// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/Crossings.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

double volume(const CrossingPlace& a, const CrossingPlace& b, const CrossingPlace& c, const CrossingPlace& d) {
  double u[3], v[3], w[3];
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
    w[k] = d[k] - a[k];
  }
  return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

// The third nodes of two faces that have this edge, in a cloth's own numbers.
std::array<int, 2> besideEdge(const GuardMesh& mesh, int a, int b) {
  std::array<int, 2> beside = {-1, -1};
  for (int k = mesh.firstTileOfNode[toSize(a)]; k < mesh.endTileOfNode[toSize(a)]; ++k) {
    const GuardMesh::Tile& tile = mesh.tiles[toSize(mesh.tilesOfNodes[toSize(k)])];
    const int end = mesh.cells[toSize(tile.endCell)].face;
    for (int face = mesh.cells[toSize(tile.cell)].face; face < end; ++face) {
      const auto& nodes = mesh.faces[toSize(face)].node;
      if (std::count(nodes, nodes + 3, a) + std::count(nodes, nodes + 3, b) < 2) continue;
      const int third = nodes[0] + nodes[1] + nodes[2] - a - b;
      beside[beside[0] < 0 ? 0 : 1] = third;
    }
  }
  return beside;
}

}  // namespace

std::optional<CrossingPoint> crossingPoint(const CrossingPlace& p, const CrossingPlace& q, const CrossingPlace& a,
                                           const CrossingPlace& b, const CrossingPlace& c) {
  const double ends[2] = {volume(p, a, b, c), volume(q, a, b, c)};
  if (!(ends[0] * ends[1] < 0)) return std::nullopt;
  const double sides[3] = {volume(p, q, b, c), volume(p, q, c, a), volume(p, q, a, b)};
  const bool isThrough =
      (sides[0] > 0 && sides[1] > 0 && sides[2] > 0) || (sides[0] < 0 && sides[1] < 0 && sides[2] < 0);
  if (!isThrough) return std::nullopt;
  const double sum = sides[0] + sides[1] + sides[2];
  return CrossingPoint{ends[0] / (ends[0] - ends[1]), {sides[0] / sum, sides[1] / sum, sides[2] / sum}};
}

void Crossings::add(const ClothGuard::Cloth& cloth, int number, const btVector3& origin) {
  const int first = static_cast<int>(m_places.size());
  m_first.push_back(first);
  for (int node = 0; node < cloth.nodeCount; ++node) m_places.push_back(crossingPlaceOf(cloth, node, origin));
  for (const GuardMesh::Face& face : cloth.mesh->faces) {
    m_faces.push_back(part({first + face.node[0], first + face.node[1], first + face.node[2]}, number));
  }
  for (const GuardMesh::Edge& edge : cloth.mesh->edges) {
    m_edges.push_back(part({first + edge.node[0], first + edge.node[1], first + edge.node[1]}, number));
  }
}

Crossings::Part Crossings::part(const std::array<int, 3>& nodes, int cloth) const {
  Part result = {nodes, cloth, {}, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto range =
        std::minmax({m_places[toSize(nodes[0])][k], m_places[toSize(nodes[1])][k], m_places[toSize(nodes[2])][k]});
    result.low[k] = range.first;
    result.high[k] = range.second;
  }
  return result;
}

bool Crossings::cross(const Part& edge, const Part& face) const {
  for (std::size_t k = 0; k < 3; ++k) {
    if (edge.low[k] > face.high[k] || face.low[k] > edge.high[k]) return false;
  }
  for (const int node : edge.node) {
    if (std::find(face.node.begin(), face.node.end(), node) != face.node.end()) return false;
  }
  return crossingPoint(m_places[toSize(edge.node[0])], m_places[toSize(edge.node[1])], m_places[toSize(face.node[0])],
                       m_places[toSize(face.node[1])], m_places[toSize(face.node[2])])
      .has_value();
}

// Faces in the order in which they begin along the first axis; the longest tells how far back one may begin.
void Crossings::find(const std::vector<ClothGuard::Cloth>& cloths, const ClothSolver::Guard& parameters) {
  m_first.clear();
  m_places.clear();
  m_faces.clear();
  m_edges.clear();
  m_found.clear();
  for (std::size_t c = 0; c < cloths.size(); ++c) add(cloths[c], static_cast<int>(c), cloths.front().origin);
  const auto beginsBefore = [](const Part& a, const Part& b) {
    return a.low[0] != b.low[0] ? a.low[0] < b.low[0] : a.node < b.node;
  };
  std::sort(m_faces.begin(), m_faces.end(), beginsBefore);
  double longest = 0;
  for (const Part& face : m_faces) longest = std::max(longest, face.high[0] - face.low[0]);
  for (const Part& edge : m_edges) {
    Part earliest = edge;
    earliest.low[0] -= longest;
    earliest.node = {-1, -1, -1};
    auto face = std::lower_bound(m_faces.begin(), m_faces.end(), earliest, beginsBefore);
    for (; face != m_faces.end() && face->low[0] <= edge.high[0]; ++face) {
      if (!(edge.cloth == face->cloth ? parameters.self : parameters.others)) continue;
      if (!cross(edge, *face)) continue;
      const int first = m_first[toSize(edge.cloth)];
      std::array<int, 2> beside =
          besideEdge(*cloths[toSize(edge.cloth)].mesh, edge.node[0] - first, edge.node[1] - first);
      for (int& node : beside) node = node < 0 ? -1 : node + first;
      m_found.push_back({{edge.node[0], edge.node[1]}, face->node, beside, {edge.cloth, face->cloth}});
    }
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
