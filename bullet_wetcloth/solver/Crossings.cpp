// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/Crossings.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

double volume(const BodyPoint& a, const BodyPoint& b, const BodyPoint& c, const BodyPoint& d) {
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

std::optional<CrossingPoint> crossingPoint(const BodyPoint& p, const BodyPoint& q, const BodyPoint& a,
                                           const BodyPoint& b, const BodyPoint& c) {
  const double ends[2] = {volume(p, a, b, c), volume(q, a, b, c)};
  if (!(ends[0] * ends[1] < 0)) return std::nullopt;
  const double sides[3] = {volume(p, q, b, c), volume(p, q, c, a), volume(p, q, a, b)};
  const bool isThrough =
      (sides[0] > 0 && sides[1] > 0 && sides[2] > 0) || (sides[0] < 0 && sides[1] < 0 && sides[2] < 0);
  if (!isThrough) return std::nullopt;
  const double sum = sides[0] + sides[1] + sides[2];
  return CrossingPoint{ends[0] / (ends[0] - ends[1]), {sides[0] / sum, sides[1] / sum, sides[2] / sum}};
}

// Of a mesh the parts of a tile follow each other.
void Crossings::add(const ClothGuard::Cloth& cloth, int number, const btVector3& origin) {
  const int first = static_cast<int>(m_places.size());
  const std::size_t firstEdge = m_edges.size();
  const std::size_t firstFace = m_faces.size();
  m_first.push_back(first);
  m_coincident.add(toSize(cloth.nodeCount), cloth.coincident);
  for (int node = 0; node < cloth.nodeCount; ++node) m_places.push_back(crossingPlaceOf(cloth, node, origin));
  for (const GuardMesh::Face& face : cloth.mesh->faces) {
    m_faces.push_back(part({first + face.node[0], first + face.node[1], first + face.node[2]}));
  }
  for (const GuardMesh::Edge& edge : cloth.mesh->edges) {
    m_edges.push_back(part({first + edge.node[0], first + edge.node[1], first + edge.node[1]}));
  }
  for (const GuardMesh::Tile& tile : cloth.mesh->tiles) {
    const GuardMesh::Cell& begin = cloth.mesh->cells[toSize(tile.cell)];
    const GuardMesh::Cell& end = cloth.mesh->cells[toSize(tile.endCell)];
    m_tiles.push_back({number,
                       firstEdge + toSize(begin.edge),
                       firstEdge + toSize(end.edge),
                       firstFace + toSize(begin.face),
                       firstFace + toSize(end.face),
                       {},
                       0,
                       0});
    Tile& added = m_tiles.back();
    for (std::size_t k = added.edge; k < added.endEdge; ++k) added.box.include(m_edges[k].box);
    for (std::size_t k = added.face; k < added.endFace; ++k) added.box.include(m_faces[k].box);
    sortFaces(added);
  }
}

void Crossings::sortFaces(Tile& tile) {
  const auto sideOf = [](const BodyBox& box, std::size_t axis) { return box.high[axis] - box.low[axis]; };
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (sideOf(tile.box, axis) > sideOf(tile.box, tile.axis)) tile.axis = axis;
  }
  const auto face = m_faces.begin();
  std::sort(face + static_cast<std::ptrdiff_t>(tile.face), face + static_cast<std::ptrdiff_t>(tile.endFace),
            [&tile](const Part& a, const Part& b) {
              const double atA = a.box.low[tile.axis];
              const double atB = b.box.low[tile.axis];
              return atA != atB ? atA < atB : a.node < b.node;
            });
  for (std::size_t k = tile.face; k < tile.endFace; ++k) {
    tile.longest = std::max(tile.longest, sideOf(m_faces[k].box, tile.axis));
  }
}

Crossings::Part Crossings::part(const std::array<int, 3>& nodes) const {
  Part result = {nodes, {}};
  for (const int node : nodes) result.box.include(m_places[toSize(node)]);
  return result;
}

bool Crossings::cross(const Part& edge, const Part& face) const {
  if (!edge.box.overlaps(face.box)) return false;
  for (const int a : edge.node) {
    for (const int b : face.node) {
      if (m_coincident.areOne(a, b)) return false;
    }
  }
  return crossingPoint(m_places[toSize(edge.node[0])], m_places[toSize(edge.node[1])], m_places[toSize(face.node[0])],
                       m_places[toSize(face.node[1])], m_places[toSize(face.node[2])])
      .has_value();
}

void Crossings::find(const std::vector<ClothGuard::Cloth>& cloths, const ClothSolver::Guard& parameters) {
  m_first.clear();
  m_coincident.clear();
  m_places.clear();
  m_faces.clear();
  m_edges.clear();
  m_tiles.clear();
  m_found.clear();
  for (std::size_t c = 0; c < cloths.size(); ++c) add(cloths[c], static_cast<int>(c), cloths.front().origin);
  for (const Tile& edges : m_tiles) {
    for (const Tile& faces : m_tiles) {
      if (!(edges.cloth == faces.cloth ? parameters.self : parameters.others)) continue;
      if (edges.box.overlaps(faces.box)) findIn(edges, faces, cloths);
    }
  }
}

void Crossings::joinCuts(const std::vector<ClothGuard::Cloth>& cloths) {
  const auto isJoined = [&](const Crossing& crossing) {
    CoincidentNodes* const coincident = cloths[toSize(crossing.cloth[0])].coincident;
    if (!coincident || crossing.cloth[0] != crossing.cloth[1]) return false;
    const int first = m_first[toSize(crossing.cloth[0])];
    bool isOne = false;
    for (const int a : crossing.edge) {
      for (const int b : crossing.face) {
        isOne = coincident->joinAgain(a - first, b - first) ||
                coincident->first(a - first) == coincident->first(b - first) || isOne;
      }
    }
    return isOne;
  };
  m_found.erase(std::remove_if(m_found.begin(), m_found.end(), isJoined), m_found.end());
}

void Crossings::findIn(const Tile& edges, const Tile& faces, const std::vector<ClothGuard::Cloth>& cloths) {
  const int firstNode = m_first[toSize(edges.cloth)];
  for (std::size_t i = edges.edge; i < edges.endEdge; ++i) {
    const Part& edge = m_edges[i];
    if (!edge.box.overlaps(faces.box)) continue;
    const double earliest = edge.box.low[faces.axis] - faces.longest;
    const auto begin = m_faces.begin() + static_cast<std::ptrdiff_t>(faces.face);
    const auto first =
        std::lower_bound(begin, m_faces.begin() + static_cast<std::ptrdiff_t>(faces.endFace), earliest,
                         [&faces](const Part& face, double place) { return face.box.low[faces.axis] < place; });
    for (std::size_t k = faces.face + static_cast<std::size_t>(first - begin); k < faces.endFace; ++k) {
      if (m_faces[k].box.low[faces.axis] > edge.box.high[faces.axis]) break;
      if (!cross(edge, m_faces[k])) continue;
      std::array<int, 2> beside =
          besideEdge(*cloths[toSize(edges.cloth)].mesh, edge.node[0] - firstNode, edge.node[1] - firstNode);
      for (int& node : beside) node = node < 0 ? -1 : node + firstNode;
      m_found.push_back({{edge.node[0], edge.node[1]}, m_faces[k].node, beside, {edges.cloth, faces.cloth}});
    }
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
