// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/EdgeFlow.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

bool moveAlike(const btSoftBody& body) {
  for (int i = 1; i < body.m_nodes.size(); ++i) {
    if (!(body.m_nodes[i].m_v == body.m_nodes[0].m_v)) return false;
  }
  return true;
}

}  // namespace

void EdgeFlow::reset(const RestMesh& mesh, std::vector<WeightedEdge> edges) {
  m_edges = std::move(edges);
  m_weights.clear();
  for (const WeightedEdge& edge : m_edges) m_weights.push_back(edge.weight);
  m_areas = mesh.nodeAreas();
  m_capacity.assign(m_areas.size(), 0);
  m_before.assign(m_areas.size(), 0);
  m_held.assign(m_areas.size(), 0);
  m_nodes.resize(m_areas.size());
  m_limiter.reset(m_areas.size());
  m_momentum.reset(m_areas.size(), m_edges);
}

bool EdgeFlow::load(const Water& water) {
  bool changed = false;
  for (std::size_t i = 0; i < m_held.size(); ++i) {
    m_before[i] = m_held[i] = water.held(i);
    changed = changed || m_capacity[i] != water.capacity(i);
    m_capacity[i] = water.capacity(i);
  }
  if (changed) weighEdges();
  return changed;
}

void EdgeFlow::weighEdges() {
  for (std::size_t e = 0; e < m_edges.size(); ++e) {
    const std::size_t a = toSize(m_edges[e].a);
    const std::size_t b = toSize(m_edges[e].b);
    const double areaPerCapacity = (m_areas[a] / m_capacity[a] + m_areas[b] / m_capacity[b]) / 2;
    m_edges[e].weight = areaPerCapacity > 0 ? m_weights[e] / areaPerCapacity : 0;
  }
}

// What load() reads again in each step is left out, but not whether the capacities will be found to have changed.
void EdgeFlow::transferState(StateArchive& archive) {
  archive.array(m_capacity);
  archive.array(m_before);
  archive.array(m_held);
  if (archive.isRestoring()) weighEdges();
}

double EdgeFlow::moved() const {
  double moved = 0;
  for (std::size_t i = 0; i < m_held.size(); ++i) moved += std::max(m_before[i] - m_held[i], 0.0);
  return moved;
}

// False: all nodes move alike, and water that goes from one to another changes no velocity.
bool EdgeFlow::carryMomentum(const btSoftBody& body, const Water& water, const std::vector<double>& fluxes) {
  if (moveAlike(body)) return false;
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {
    const btSoftBody::Node& node = body.m_nodes[static_cast<int>(i)];
    for (int c = 0; c < 3; ++c) m_nodes[i].velocity[toSize(c)] = static_cast<double>(node.m_v[c]);
    m_nodes[i].mass = water.totalMass(i);
    m_nodes[i].isFixed = node.m_im == 0;
  }
  m_momentum.apply(m_edges, fluxes, m_nodes);
  return true;
}

btVector3 EdgeFlow::velocityChange(const btSoftBody& body, int node) const {
  const auto change = [&](int c) {
    return static_cast<btScalar>(m_nodes[toSize(node)].velocity[toSize(c)] -
                                 static_cast<double>(body.m_nodes[node].m_v[c]));
  };
  return btVector3(change(0), change(1), change(2));
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
