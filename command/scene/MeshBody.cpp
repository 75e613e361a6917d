// SPDX-License-Identifier: Zlib
#include "command/scene/MeshBody.h"

#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

namespace command {
namespace {

std::vector<btScalar> nodeMasses(const TriangleMesh& mesh, double arealDensity) {
  std::vector<double> masses(mesh.vertices.size(), 0);
  for (const auto& [a, b, c] : mesh.triangles) {
    const btVector3& origin = mesh.vertices[static_cast<std::size_t>(a)];
    const btVector3 u = mesh.vertices[static_cast<std::size_t>(b)] - origin;
    const btVector3 v = mesh.vertices[static_cast<std::size_t>(c)] - origin;
    const double third = arealDensity * static_cast<double>(u.cross(v).length()) / 6;
    for (const int corner : {a, b, c}) masses[static_cast<std::size_t>(corner)] += third;
  }
  return {masses.begin(), masses.end()};
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
  const auto opposite = oppositeNodes(mesh);
  for (const auto& [edge, nodes] : opposite) body->appendLink(edge.first, edge.second);
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
    }
  }
  for (const auto& [a, b, c] : mesh.triangles) body->appendFace(a, b, c);
  btSoftBodyHelpers::ReoptimizeLinkOrder(body.get());  // halves Bullet's time per link
  return body;
}

}  // namespace command
