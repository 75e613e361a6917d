// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/Crossings.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

using CrossingPlace = std::array<double, 3>;

double volume(const CrossingPlace& a, const CrossingPlace& b, const CrossingPlace& c, const CrossingPlace& d) {
  double u[3], v[3], w[3];
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
    w[k] = d[k] - a[k];
  }
  return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

// A face, or an edge whose third corner is its second.
struct CrossingPart {
  std::array<int, 3> node;
  double low[3];
  double high[3];
};

// All parts of all cloths, in one frame.
struct CrossingScene {
  std::vector<CrossingPlace> places;
  std::vector<CrossingPart> faces;
  std::vector<CrossingPart> edges;

  void add(const ClothGuard::Cloth& cloth, const btVector3& away) {
    const int first = static_cast<int>(places.size());
    for (int node = 0; node < cloth.nodeCount; ++node) {
      const std::size_t slot = toSize(cloth.slots[node]);
      CrossingPlace place;
      for (std::size_t k = 0; k < 3; ++k) {
        place[k] = static_cast<double>(cloth.nodes.position[k][slot]) + static_cast<double>(away[static_cast<int>(k)]);
      }
      places.push_back(place);
    }
    for (const GuardMesh::Face& face : cloth.mesh->faces) {
      faces.push_back(part({first + face.node[0], first + face.node[1], first + face.node[2]}));
    }
    for (const GuardMesh::Edge& edge : cloth.mesh->edges) {
      edges.push_back(part({first + edge.node[0], first + edge.node[1], first + edge.node[1]}));
    }
  }
  bool cross(const CrossingPart& edge, const CrossingPart& face) const {
    for (const int node : edge.node) {
      if (std::find(face.node.begin(), face.node.end(), node) != face.node.end()) return false;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (edge.low[k] > face.high[k] || face.low[k] > edge.high[k]) return false;
    }
    const CrossingPlace& p = places[toSize(edge.node[0])];
    const CrossingPlace& q = places[toSize(edge.node[1])];
    const CrossingPlace& a = places[toSize(face.node[0])];
    const CrossingPlace& b = places[toSize(face.node[1])];
    const CrossingPlace& c = places[toSize(face.node[2])];
    if (!(volume(p, a, b, c) * volume(q, a, b, c) < 0)) return false;
    const double sides[3] = {volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)};
    return (sides[0] > 0 && sides[1] > 0 && sides[2] > 0) || (sides[0] < 0 && sides[1] < 0 && sides[2] < 0);
  }

 private:
  CrossingPart part(const std::array<int, 3>& nodes) const {
    CrossingPart result = {nodes, {}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto range =
          std::minmax({places[toSize(nodes[0])][k], places[toSize(nodes[1])][k], places[toSize(nodes[2])][k]});
      result.low[k] = range.first;
      result.high[k] = range.second;
    }
    return result;
  }
};

}  // namespace

// Faces in the order in which they begin along the first axis; the longest tells how far back one may begin.
long long crossingsOf(const std::vector<ClothGuard::Cloth>& cloths) {
  if (cloths.empty()) return 0;
  CrossingScene scene;
  for (const ClothGuard::Cloth& cloth : cloths) scene.add(cloth, cloth.origin - cloths.front().origin);
  const auto beginsBefore = [](const CrossingPart& a, const CrossingPart& b) { return a.low[0] < b.low[0]; };
  std::sort(scene.faces.begin(), scene.faces.end(), beginsBefore);
  double longest = 0;
  for (const CrossingPart& face : scene.faces) longest = std::max(longest, face.high[0] - face.low[0]);
  long long count = 0;
  for (const CrossingPart& edge : scene.edges) {
    CrossingPart earliest = edge;
    earliest.low[0] -= longest;
    auto face = std::lower_bound(scene.faces.begin(), scene.faces.end(), earliest, beginsBefore);
    for (; face != scene.faces.end() && face->low[0] <= edge.high[0]; ++face) count += scene.cross(edge, *face) ? 1 : 0;
  }
  return count;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
