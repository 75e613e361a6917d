// SPDX-License-Identifier: Zlib
#include "command/scene/Garment.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <stdexcept>

namespace command {
namespace {

/// Sets of panel nodes that are one node of the garment (union-find).
class JoinedNodes {
 public:
  explicit JoinedNodes(const std::vector<GarmentPanel>& panels) {
    for (const GarmentPanel& panel : panels) {
      m_first.push_back(m_parents.size());
      m_parents.resize(m_parents.size() + panel.mesh.vertices.size());
    }
    std::iota(m_parents.begin(), m_parents.end(), std::size_t{0});
  }

  void join(const PanelNode& a, const PanelNode& b) {
    const std::size_t one = root(number(a)), other = root(number(b));
    m_parents[std::max(one, other)] = std::min(one, other);
  }
  std::size_t number(const PanelNode& node) const { return m_first[node.panel] + static_cast<std::size_t>(node.node); }
  std::size_t root(std::size_t node) const {
    while (m_parents[node] != node) node = m_parents[node];
    return node;
  }
  std::size_t size() const { return m_parents.size(); }

 private:
  std::vector<std::size_t> m_first;  // of each panel
  std::vector<std::size_t> m_parents;
};

double distance(const TriangleMesh& mesh, int a, int b) {
  return static_cast<double>(
      (mesh.vertices[static_cast<std::size_t>(a)] - mesh.vertices[static_cast<std::size_t>(b)]).length());
}

class Sewing {
 public:
  Sewing(const std::vector<GarmentPanel>& panels, const std::vector<Stitch>& stitches)
      : m_panels(panels), m_joined(panels) {
    for (const Stitch& stitch : stitches) m_joined.join(stitch.first, stitch.second);
  }

  SewnMesh sew() {
    takeNodes();
    for (std::size_t p = 0; p < m_panels.size(); ++p) takeTriangles(p);
    turnToOneSide();
    return std::move(m_sewn);
  }

 private:
  void takeNodes() {
    m_nodeOf.assign(m_joined.size(), -1);
    std::vector<int> counts;
    for (std::size_t p = 0; p < m_panels.size(); ++p) {
      const TriangleMesh& panel = m_panels[p].mesh;
      for (int i = 0; i < static_cast<int>(panel.vertices.size()); ++i) {
        const std::size_t root = m_joined.root(m_joined.number({p, i}));
        if (m_nodeOf[root] < 0) {
          m_nodeOf[root] = static_cast<int>(counts.size());
          counts.push_back(0);
          m_sewn.mesh.vertices.emplace_back(0, 0, 0);
          m_sewn.mesh.sheet.push_back(panel.sheet[static_cast<std::size_t>(i)]);
          m_sewn.fabricOfNode.push_back(m_panels[p].fabric);
        }
        const auto node = static_cast<std::size_t>(m_nodeOf[root]);
        m_sewn.mesh.vertices[node] += panel.vertices[static_cast<std::size_t>(i)];
        ++counts[node];
        m_sewn.mesh.groups[m_panels[p].name].push_back(m_nodeOf[root]);
      }
    }
    for (std::size_t i = 0; i < counts.size(); ++i) m_sewn.mesh.vertices[i] /= btScalar(counts[i]);
    for (auto& [name, nodes] : m_sewn.mesh.groups) {
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
  }

  void takeTriangles(std::size_t p) {
    const TriangleMesh& panel = m_panels[p].mesh;
    for (const auto& [a, b, c] : panel.triangles) {
      const auto node = [&](int i) { return m_nodeOf[m_joined.root(m_joined.number({p, i}))]; };
      const std::array<int, 3> corners{node(a), node(b), node(c)};
      if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
        throw std::invalid_argument("the seams join two corners of a triangle of panel \"" + m_panels[p].name + "\"");
      }
      m_sewn.mesh.triangles.push_back(corners);
      m_sewn.mesh.restEdges.push_back({distance(panel, b, c), distance(panel, c, a), distance(panel, a, b)});
      m_sewn.mesh.arealDensities.push_back(m_panels[p].arealDensity);
      m_sewn.fabricOfTriangle.push_back(m_panels[p].fabric);
    }
  }

  /// Goes over each piece from its first triangle. At an edge of more than two triangles the sides may differ.
  void turnToOneSide() {
    std::map<std::pair<int, int>, std::vector<std::size_t>> trianglesAt;
    auto& triangles = m_sewn.mesh.triangles;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        trianglesAt[std::minmax(triangles[t][k], triangles[t][(k + 1) % 3])].push_back(t);
      }
    }
    std::vector<bool> isKnown(triangles.size(), false);
    for (std::size_t first = 0; first < triangles.size(); ++first) {
      if (isKnown[first]) continue;
      isKnown[first] = true;
      std::vector<std::size_t> ahead{first};
      while (!ahead.empty()) {
        const std::size_t t = ahead.back();
        ahead.pop_back();
        for (std::size_t k = 0; k < 3; ++k) {
          const int from = triangles[t][k], to = triangles[t][(k + 1) % 3];
          for (const std::size_t other : trianglesAt[std::minmax(from, to)]) {
            if (isKnown[other]) continue;
            isKnown[other] = true;
            if (goesAlong(triangles[other], from, to)) turn(other);
            ahead.push_back(other);
          }
        }
      }
    }
  }
  static bool goesAlong(const std::array<int, 3>& corners, int from, int to) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (corners[k] == from && corners[(k + 1) % 3] == to) return true;
    }
    return false;
  }
  void turn(std::size_t triangle) {
    std::swap(m_sewn.mesh.triangles[triangle][1], m_sewn.mesh.triangles[triangle][2]);
    std::swap(m_sewn.mesh.restEdges[triangle][1], m_sewn.mesh.restEdges[triangle][2]);
  }

  const std::vector<GarmentPanel>& m_panels;
  JoinedNodes m_joined;
  std::vector<int> m_nodeOf;  // of each root; -1: none yet
  SewnMesh m_sewn;
};

}  // namespace

SewnMesh sewn(const std::vector<GarmentPanel>& panels, const std::vector<Stitch>& stitches) {
  return Sewing(panels, stitches).sew();
}

}  // namespace command
