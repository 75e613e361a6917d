// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/MomentumFlow.h"

#include "bullet_wetcloth/bullet/Index.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr int kDone = -1;

// v' - v = sum of in (v_from - v) / (m - out + in), which leaves even motion exactly as it is.
void mix(MomentumFlow::Node& node, const std::array<double, 3>& momentum, double inflow, double outflow) {
  const double mass = node.mass - outflow + inflow;
  if (node.isFixed || !(mass > 0) || !(inflow > 0)) return;
  for (std::size_t c = 0; c < 3; ++c) node.velocity[c] += momentum[c] / mass;
}

}  // namespace

void MomentumFlow::reset(std::size_t nodeCount, const std::vector<WeightedEdge>& edges) {
  m_inflows.assign(nodeCount, Inflow());
  m_ready.reserve(nodeCount);
  m_firstEdge.assign(nodeCount + 1, 0);
  for (const WeightedEdge& edge : edges) {
    ++m_firstEdge[toSize(edge.a) + 1];
    ++m_firstEdge[toSize(edge.b) + 1];
  }
  for (std::size_t i = 0; i < nodeCount; ++i) m_firstEdge[i + 1] += m_firstEdge[i];
  m_edgesOfNode.resize(2 * edges.size());
  std::vector<std::size_t> next(m_firstEdge.begin(), m_firstEdge.end() - 1);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    m_edgesOfNode[next[toSize(edges[e].a)]++] = static_cast<int>(e);
    m_edgesOfNode[next[toSize(edges[e].b)]++] = static_cast<int>(e);
  }
}

void MomentumFlow::apply(const std::vector<WeightedEdge>& edges, const std::vector<double>& fluxes,
                         std::vector<Node>& nodes) {
  if (!mixAtOnce(edges, fluxes, nodes)) mixInOrder(edges, fluxes, nodes);
}

// False, and nothing is done: a node gives more than it weighs.
bool MomentumFlow::mixAtOnce(const std::vector<WeightedEdge>& edges, const std::vector<double>& fluxes,
                             std::vector<Node>& nodes) {
  for (Inflow& inflow : m_inflows) inflow = Inflow();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const bool isForward = fluxes[e] > 0;
    const std::size_t from = toSize(isForward ? edges[e].a : edges[e].b);
    const std::size_t to = toSize(isForward ? edges[e].b : edges[e].a);
    const double mass = isForward ? fluxes[e] : -fluxes[e];
    m_inflows[from].out += mass;
    Inflow& inflow = m_inflows[to];
    inflow.mass += mass;
    for (std::size_t c = 0; c < 3; ++c) {
      inflow.momentum[c] += mass * (nodes[from].velocity[c] - nodes[to].velocity[c]);
    }
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!(m_inflows[i].out <= nodes[i].mass)) return false;
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    mix(nodes[i], m_inflows[i].momentum, m_inflows[i].mass, m_inflows[i].out);
  }
  return true;
}

void MomentumFlow::mixInOrder(const std::vector<WeightedEdge>& edges, const std::vector<double>& fluxes,
                              std::vector<Node>& nodes) {
  countInflows(edges, fluxes);
  m_ready.clear();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (m_inflows[i].pending > 0 && !nodes[i].isFixed) continue;
    m_inflows[i].pending = kDone;
    m_ready.push_back(static_cast<int>(i));
  }
  std::size_t done = 0;
  for (; done < m_ready.size(); ++done) {
    const std::size_t i = toSize(m_ready[done]);
    mix(nodes[i], m_inflows[i].momentum, m_inflows[i].mass, 0);
    passOn(m_ready[done], edges, fluxes, nodes);
  }
  if (done < nodes.size()) stirCircles(nodes);
}

void MomentumFlow::countInflows(const std::vector<WeightedEdge>& edges, const std::vector<double>& fluxes) {
  for (Inflow& inflow : m_inflows) inflow = Inflow();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (fluxes[e] > 0) ++m_inflows[toSize(edges[e].b)].pending;
    if (fluxes[e] < 0) ++m_inflows[toSize(edges[e].a)].pending;
  }
}

void MomentumFlow::passOn(int from, const std::vector<WeightedEdge>& edges, const std::vector<double>& fluxes,
                          const std::vector<Node>& nodes) {
  for (std::size_t k = m_firstEdge[toSize(from)]; k < m_firstEdge[toSize(from) + 1]; ++k) {
    const std::size_t e = toSize(m_edgesOfNode[k]);
    const bool isStart = edges[e].a == from;
    const double mass = isStart ? fluxes[e] : -fluxes[e];
    if (!(mass > 0)) continue;
    const int to = isStart ? edges[e].b : edges[e].a;
    Inflow& inflow = m_inflows[toSize(to)];
    if (inflow.pending == kDone) continue;  // fixed
    inflow.mass += mass;
    for (std::size_t c = 0; c < 3; ++c) {
      inflow.momentum[c] += mass * (nodes[toSize(from)].velocity[c] - nodes[toSize(to)].velocity[c]);
    }
    if (--inflow.pending > 0) continue;
    inflow.pending = kDone;
    m_ready.push_back(to);
  }
}

// The nodes that are left are those that lie on or behind a circle. Nothing flows from them to others that are free.
void MomentumFlow::stirCircles(std::vector<Node>& nodes) {
  double mass = 0;
  std::array<double, 3> momentum = {0, 0, 0};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (m_inflows[i].pending == kDone) continue;
    mass += nodes[i].mass + m_inflows[i].mass;
    for (std::size_t c = 0; c < 3; ++c) {
      momentum[c] += (nodes[i].mass + m_inflows[i].mass) * nodes[i].velocity[c] + m_inflows[i].momentum[c];
    }
  }
  if (!(mass > 0)) return;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (m_inflows[i].pending == kDone) continue;
    for (std::size_t c = 0; c < 3; ++c) nodes[i].velocity[c] = momentum[c] / mass;
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
