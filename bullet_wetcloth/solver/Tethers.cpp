// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/Tethers.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// One end of a link, seen from the other one.
struct Neighbour {
  std::size_t node;
  btScalar length;
};

// A way from a pin to a node.
struct Way {
  btScalar length;
  std::size_t node;
  std::size_t pin;
  bool operator>(const Way& other) const {
    if (length != other.length) return length > other.length;
    return node != other.node ? node > other.node : pin > other.pin;
  }
};

std::vector<std::vector<Neighbour>> neighboursOf(const btSoftBody& body) {
  std::vector<std::vector<Neighbour>> neighbours(toSize(body.m_nodes.size()));
  for (int k = 0; k < body.m_links.size(); ++k) {
    const btSoftBody::Link& link = body.m_links[k];
    const std::size_t a = toSize(nodeIndex(body, link.m_n[0]));
    const std::size_t b = toSize(nodeIndex(body, link.m_n[1]));
    neighbours[a].push_back({b, link.m_rl});
    neighbours[b].push_back({a, link.m_rl});
  }
  return neighbours;
}

// The shortest ways from pins to each node that is none, at most `most` each (Dijkstra from all pins at once).
std::vector<Way> shortestWays(const btSoftBody& body, std::size_t most) {
  const std::vector<std::vector<Neighbour>> neighbours = neighboursOf(body);
  std::vector<std::vector<std::size_t>> pinsOf(neighbours.size());
  std::priority_queue<Way, std::vector<Way>, std::greater<Way>> open;
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    if (body.m_nodes[static_cast<int>(k)].m_im == 0) open.push({0, k, k});
  }
  std::vector<Way> ways;
  while (!open.empty()) {
    const Way way = open.top();
    open.pop();
    std::vector<std::size_t>& known = pinsOf[way.node];
    const bool isPin = body.m_nodes[static_cast<int>(way.node)].m_im == 0;
    if (known.size() >= (isPin ? 1 : most) || std::find(known.begin(), known.end(), way.pin) != known.end()) continue;
    known.push_back(way.pin);
    if (!isPin) ways.push_back(way);
    for (const Neighbour& next : neighbours[way.node]) open.push({way.length + next.length, next.node, way.pin});
  }
  return ways;
}

}  // namespace

void Tethers::follow(const btSoftBody& body, const LocalNodes& nodes, int perNode, btScalar scale) {
  if (perNode == 0) {
    m_tethers.clear();
    m_perNode = 0;
    return;
  }
  if (m_perNode == perNode && m_scale == scale && arePinsKnown(nodes)) return;
  m_perNode = perNode;
  m_scale = scale;
  build(body, nodes);
}

// No other node is pinned, and all that were are.
bool Tethers::arePinsKnown(const LocalNodes& nodes) const {
  const auto isPinned = [&](std::size_t slot) { return nodes.inverseMass[slot] == 0; };
  if (!std::all_of(m_pins.begin(), m_pins.end(), isPinned)) return false;
  std::size_t count = 0;
  for (int k = 0; k < nodes.nodeCount(); ++k) count += isPinned(nodes.slot(toSize(k))) ? 1 : 0;
  return count == m_pins.size();
}

void Tethers::build(const btSoftBody& body, const LocalNodes& nodes) {
  m_pins.clear();
  for (int k = 0; k < body.m_nodes.size(); ++k) {
    if (body.m_nodes[k].m_im == 0) m_pins.push_back(nodes.slot(toSize(k)));
  }
  m_tethers.clear();
  for (const Way& way : shortestWays(body, toSize(m_perNode))) {
    m_tethers.push_back({nodes.slot(way.node), nodes.slot(way.pin), way.length * m_scale});
  }
}

void Tethers::project(const MovingNodes& nodes) const {
  for (const Tether& tether : m_tethers) {
    const btVector3 pin = nodes.placeOf(tether.pin);
    const btVector3 away = nodes.placeOf(tether.slot) - pin;
    const btScalar squared = away.length2();
    if (squared <= tether.length * tether.length) continue;
    const btVector3 place = pin + away * (tether.length / std::sqrt(squared));
    for (int axis = 0; axis < 3; ++axis) nodes.position[axis][tether.slot] = place[axis];
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
