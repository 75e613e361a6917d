// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/mesh/MeshCheck.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/bullet/Layers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

using Triangle = std::array<int, 3>;

// A face with less is a line, as a share of its longest side squared: what float32 makes of a line.
constexpr double kNoArea = 1e-7;

// Sets that are joined two by two.
class Sets {
 public:
  explicit Sets(std::size_t count) : m_parent(count) { std::iota(m_parent.begin(), m_parent.end(), 0); }

  int of(int i) {
    while (m_parent[toSize(i)] != i) {
      m_parent[toSize(i)] = m_parent[toSize(m_parent[toSize(i)])];
      i = m_parent[toSize(i)];
    }
    return i;
  }
  void join(int a, int b) { m_parent[toSize(of(a))] = of(b); }

 private:
  std::vector<int> m_parent;
};

// An edge of one face, lower node first.
struct Side {
  std::array<int, 2> nodes;
  int face;
};

struct Box {
  btVector3 low = btVector3(0, 0, 0);
  double size = 0;
};

Box boxOf(const std::vector<btVector3>& positions) {
  btVector3 low(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT);
  btVector3 high = -low;
  for (const btVector3& position : positions) {
    if (!isFinite(position)) continue;
    low.setMin(position);
    high.setMax(position);
  }
  if (!(low.x() <= high.x())) return {};
  const double x = static_cast<double>(high.x()) - static_cast<double>(low.x());
  const double y = static_cast<double>(high.y()) - static_cast<double>(low.y());
  const double z = static_cast<double>(high.z()) - static_cast<double>(low.z());
  return {low, std::sqrt(x * x + y * y + z * z)};
}

// The first nodes of all places, in cells some tolerances wide, so that most nodes look into one cell only.
class Places {
 public:
  Places(const std::vector<btVector3>& positions, const Box& box, double tolerance)
      : m_positions(positions), m_low(box.low), m_tolerance(tolerance), m_cell(tolerance > 0 ? 8 * tolerance : 1) {}

  // The first node in the place of node i, which is i when no earlier one is there.
  int firstAt(int i) {
    const btVector3& place = m_positions[toSize(i)];
    if (!isFinite(place)) return i;
    std::array<std::int64_t, 3> from, to;
    for (int axis = 0; axis < 3; ++axis) {
      const double along = static_cast<double>(place[axis]) - static_cast<double>(m_low[axis]);
      from[toSize(axis)] = static_cast<std::int64_t>(std::floor((along - m_tolerance) / m_cell));
      to[toSize(axis)] = static_cast<std::int64_t>(std::floor((along + m_tolerance) / m_cell));
    }
    int first = i;
    for (std::int64_t x = from[0]; x <= to[0]; ++x) {
      for (std::int64_t y = from[1]; y <= to[1]; ++y) {
        for (std::int64_t z = from[2]; z <= to[2]; ++z) first = std::min(first, firstIn(keyOf(x, y, z), place, i));
      }
    }
    if (first == i) m_cells[keyOf(cellOf(place, 0), cellOf(place, 1), cellOf(place, 2))].push_back(i);
    return first;
  }

 private:
  std::int64_t cellOf(const btVector3& place, int axis) const {
    return static_cast<std::int64_t>(
        std::floor((static_cast<double>(place[axis]) - static_cast<double>(m_low[axis])) / m_cell));
  }
  // A mesh is 125,000 cells long at most: each takes 18 bits.
  static std::int64_t keyOf(std::int64_t x, std::int64_t y, std::int64_t z) {
    return ((x + 1) * (1 << 20) + y + 1) * (1 << 20) + z + 1;
  }
  int firstIn(std::int64_t key, const btVector3& place, int otherwise) const {
    const auto cell = m_cells.find(key);
    if (cell == m_cells.end()) return otherwise;
    for (const int node : cell->second) {
      if (static_cast<double>((m_positions[toSize(node)] - place).length()) <= m_tolerance) return node;
    }
    return otherwise;
  }

  const std::vector<btVector3>& m_positions;
  btVector3 m_low;
  double m_tolerance;
  double m_cell;
  std::unordered_map<std::int64_t, std::vector<int>> m_cells;
};

bool isDegenerate(const std::vector<btVector3>& positions, const Triangle& corners) {
  if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return true;
  const btVector3 u = positions[toSize(corners[1])] - positions[toSize(corners[0])];
  const btVector3 v = positions[toSize(corners[2])] - positions[toSize(corners[0])];
  const double longest = static_cast<double>(std::max({u.length2(), v.length2(), (u - v).length2()}));
  return !(static_cast<double>(u.cross(v).length()) > kNoArea * longest);
}

std::vector<int> doubled(const std::vector<Triangle>& triangles) {
  const std::vector<bool> isDoubled = areDoubled(triangles);
  std::vector<int> faces;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    if (isDoubled[f]) faces.push_back(static_cast<int>(f));
  }
  return faces;
}

std::vector<Side> sidesOf(const std::vector<Triangle>& triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(triangles[f][k], triangles[f][(k + 1) % 3]);
      if (a != b) sides.push_back({{a, b}, static_cast<int>(f)});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return a.nodes != b.nodes ? a.nodes < b.nodes : a.face < b.face; });
  return sides;
}

std::vector<std::array<int, 2>> nonManifold(const std::vector<Side>& sides, const std::vector<int>& doubledFaces) {
  std::vector<std::array<int, 2>> edges;
  for (std::size_t k = 0; k < sides.size();) {
    const std::array<int, 2> edge = sides[k].nodes;
    int faces = 0;
    for (; k < sides.size() && sides[k].nodes == edge; ++k) {
      if (!std::binary_search(doubledFaces.begin(), doubledFaces.end(), sides[k].face)) ++faces;
    }
    if (faces > 2) edges.push_back(edge);
  }
  return edges;
}

int facePieces(const std::vector<Side>& sides, std::size_t faces) {
  Sets sets(faces);
  for (std::size_t k = 1; k < sides.size(); ++k) {
    if (sides[k].nodes == sides[k - 1].nodes) sets.join(sides[k].face, sides[k - 1].face);
  }
  int pieces = 0;
  for (std::size_t f = 0; f < faces; ++f) pieces += sets.of(static_cast<int>(f)) == static_cast<int>(f) ? 1 : 0;
  return pieces;
}

using Pairs = std::vector<std::array<int, 2>>;

// Without a body there are no links to look at.
void findParts(const std::vector<Triangle>& triangles, const Pairs* links, MeshReport& report) {
  const std::size_t nodes = toSize(report.nodes);
  Sets parts(nodes), linked(nodes);
  std::vector<bool> isUsed(nodes, false);
  for (const Triangle& corners : triangles) {
    for (const int corner : corners) {
      parts.join(corner, corners[0]);
      isUsed[toSize(corner)] = true;
    }
  }
  for (const auto& [a, b] : links ? *links : Pairs()) {
    parts.join(a, b);
    linked.join(a, b);
    isUsed[toSize(a)] = isUsed[toSize(b)] = true;
  }
  for (int i = 0; i < report.nodes; ++i) {
    if (!isUsed[toSize(i)]) report.strayNodes.push_back(i);
    if (isUsed[toSize(i)] && parts.of(i) == i) ++report.parts;
    if (links && linked.of(i) == i) ++report.nodePieces;
  }
}

MeshReport check(const std::vector<btVector3>& positions, const std::vector<Triangle>& triangles, const Pairs* links) {
  MeshReport report;
  report.nodes = static_cast<int>(positions.size());
  report.faces = static_cast<int>(triangles.size());
  const Box box = boxOf(positions);
  report.size = box.size;
  report.tolerance = MeshReport::toleranceOfSize * box.size;
  Places places(positions, box, report.tolerance);
  for (int i = 0; i < report.nodes; ++i) {
    report.firstAt.push_back(places.firstAt(i));
    if (report.firstAt.back() != i) ++report.coincidentNodes;
  }
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    if (isDegenerate(positions, triangles[f])) report.degenerateFaces.push_back(static_cast<int>(f));
  }
  report.doubledFaces = doubled(triangles);
  const std::vector<Side> sides = sidesOf(triangles);
  report.nonManifoldEdges = nonManifold(sides, report.doubledFaces);
  report.facePieces = facePieces(sides, triangles.size());
  findParts(triangles, links, report);
  return report;
}

}  // namespace

MeshReport checkMesh(const std::vector<btVector3>& positions, const std::vector<Triangle>& triangles) {
  return check(positions, triangles, nullptr);
}

MeshReport checkMesh(const btSoftBody& body) {
  std::vector<btVector3> positions;
  for (int i = 0; i < body.m_nodes.size(); ++i) positions.push_back(body.m_nodes[i].m_x);
  Pairs links;
  for (int k = 0; k < body.m_links.size(); ++k) {
    const auto& nodes = body.m_links[k].m_n;
    links.push_back({nodeIndex(body, nodes[0]), nodeIndex(body, nodes[1])});
  }
  return check(positions, nodesOfFaces(body), &links);
}

std::string MeshReport::summary() const {
  std::string text;
  const auto tell = [&](std::size_t count, const char* one, const char* many) {
    if (count == 0) return;
    text += (text.empty() ? "" : "; ") + std::to_string(count) + " " + (count == 1 ? one : many);
  };
  if (parts > 1) tell(toSize(parts), "", "parts that nothing joins");
  tell(toSize(coincidentNodes), "node in the place of another", "nodes in the places of others");
  tell(strayNodes.size(), "node of no face", "nodes of no face");
  tell(degenerateFaces.size(), "face without area", "faces without area");
  tell(doubledFaces.size(), "face there twice", "faces there twice");
  tell(nonManifoldEdges.size(), "edge of more than two faces", "edges of more than two faces");
  return text;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
