// SPDX-License-Identifier: Zlib
#include "command/scene/MeshBody.h"

#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace command {
namespace {

double areaAsItIs(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const btVector3& origin = mesh.vertices[static_cast<std::size_t>(a)];
  const btVector3 u = mesh.vertices[static_cast<std::size_t>(b)] - origin;
  const btVector3 v = mesh.vertices[static_cast<std::size_t>(c)] - origin;
  return static_cast<double>(u.cross(v).length()) / 2;
}

/// Heron's formula, from the lengths of the edges.
double areaAtRest(const std::array<double, 3>& edges) {
  const double half = (edges[0] + edges[1] + edges[2]) / 2;
  return std::sqrt(std::max(0.0, half * (half - edges[0]) * (half - edges[1]) * (half - edges[2])));
}

std::vector<btScalar> nodeMasses(const TriangleMesh& mesh, double arealDensity) {
  std::vector<double> masses(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double density = mesh.arealDensities.empty() ? arealDensity : mesh.arealDensities[t];
    const double area = mesh.restEdges.empty() ? areaAsItIs(mesh, t) : areaAtRest(mesh.restEdges[t]);
    for (const int corner : mesh.triangles[t]) masses[static_cast<std::size_t>(corner)] += density * area / 3;
  }
  return {masses.begin(), masses.end()};
}

/// How high a triangle's third corner stands over an edge, and how far along the edge from its first end [m].
struct Apex {
  double along;
  double height;
};
Apex apexOver(double edge, double fromFirst, double fromSecond) {
  const double along = (edge * edge + fromFirst * fromFirst - fromSecond * fromSecond) / (2 * edge);
  return {along, std::sqrt(std::max(0.0, fromFirst * fromFirst - along * along))};
}

/// The lengths at rest of a mesh that has them: of its edges, and across them where both triangles are unfolded.
class RestLengthsOf {
 public:
  explicit RestLengthsOf(const TriangleMesh& mesh) {
    for (std::size_t t = 0; t < mesh.restEdges.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const int a = mesh.triangles[t][(k + 1) % 3], b = mesh.triangles[t][(k + 2) % 3];
        m_edges[std::minmax(a, b)].push_back(mesh.restEdges[t][k]);
      }
    }
  }
  bool isEmpty() const { return m_edges.empty(); }

  /// The mean where two panels do not agree.
  double along(int a, int b) const {
    const std::vector<double>& found = m_edges.at(std::minmax(a, b));
    return std::accumulate(found.begin(), found.end(), 0.0) / static_cast<double>(found.size());
  }
  double across(const std::pair<int, int>& edge, int one, int other) const {
    const double length = along(edge.first, edge.second);
    const Apex a = apexOver(length, along(edge.first, one), along(edge.second, one));
    const Apex b = apexOver(length, along(edge.first, other), along(edge.second, other));
    return std::hypot(a.along - b.along, a.height + b.height);
  }

 private:
  std::map<std::pair<int, int>, std::vector<double>> m_edges;
};

/// Bullet takes each link's length as it is now, in its next step or here; ours come after.
void setRestLengths(btSoftBody& body, const std::map<std::pair<int, int>, double>& lengths) {
  body.updateConstants();
  body.m_bUpdateRtCst = false;
  const btSoftBody::Node* const first = &body.m_nodes[0];
  for (int k = 0; k < body.m_links.size(); ++k) {
    btSoftBody::Link& link = body.m_links[k];
    const std::pair<int, int> ends =
        std::minmax(static_cast<int>(link.m_n[0] - first), static_cast<int>(link.m_n[1] - first));
    link.m_rl = btScalar(lengths.at(ends));
    link.m_c1 = link.m_rl * link.m_rl;
  }
}

/// Each edge, lower node first, and the nodes opposite to it.
std::map<std::pair<int, int>, std::vector<int>> oppositeNodes(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, std::vector<int>> opposite;
  for (const auto& [a, b, c] : mesh.triangles) {
    opposite[std::minmax(a, b)].push_back(c);
    opposite[std::minmax(b, c)].push_back(a);
    opposite[std::minmax(c, a)].push_back(b);
  }
  return opposite;
}

}  // namespace

std::unique_ptr<btSoftBody> makeMeshBody(const TriangleMesh& mesh, double arealDensity,
                                         btSoftBodyWorldInfo& worldInfo) {
  auto body = wetcloth::looseNodes(worldInfo, mesh.vertices, nodeMasses(mesh, arealDensity));
  btSoftBody::Material* const bending = body->appendMaterial();
  bending->m_kLST = btScalar(mesh.flexionStiffness);
  const auto opposite = oppositeNodes(mesh);
  const RestLengthsOf rest(mesh);
  std::map<std::pair<int, int>, double> lengths;
  for (const auto& [edge, nodes] : opposite) {
    body->appendLink(edge.first, edge.second);
    if (!rest.isEmpty()) lengths[edge] = rest.along(edge.first, edge.second);
  }
  std::set<std::pair<int, int>> bent;
  for (const auto& [edge, nodes] : opposite) {
    // Each face is bent against the next; where more than two meet, the last one against the first, too.
    const std::size_t folds = nodes.size() == 2 ? 1 : nodes.size() < 2 ? 0 : nodes.size();
    for (std::size_t k = 0; k < folds; ++k) {
      const std::pair<int, int> across = std::minmax(nodes[k], nodes[(k + 1) % nodes.size()]);
      if (across.first == across.second || opposite.count(across) != 0) continue;
      if (!bent.insert(across).second) continue;  // there is a link already
      body->appendLink(across.first, across.second, bending);
      body->m_links[body->m_links.size() - 1].m_bbending = -1;  // a signed field of one bit
      if (!rest.isEmpty()) lengths[across] = rest.across(edge, nodes[k], nodes[(k + 1) % nodes.size()]);
    }
  }
  for (const auto& [a, b, c] : mesh.triangles) body->appendFace(a, b, c);
  btSoftBodyHelpers::ReoptimizeLinkOrder(body.get());  // halves Bullet's time per link
  if (!rest.isEmpty()) setRestLengths(*body, lengths);
  return body;
}

}  // namespace command
