// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardGroups.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

void GuardGroups::clear(std::size_t nodes) {
  if (m_parent.size() != nodes) {
    m_parent.assign(nodes, -1);
    m_groups.resize(nodes);
  }
  for (const int node : m_members) m_parent[toSize(node)] = -1;
  m_members.clear();
}

int GuardGroups::find(int node) {
  while (m_parent[toSize(node)] != node) {
    m_parent[toSize(node)] = m_parent[toSize(m_parent[toSize(node)])];
    node = m_parent[toSize(node)];
  }
  return node;
}

void GuardGroups::join(const int (&nodes)[4]) {
  for (const int node : nodes) {
    if (m_parent[toSize(node)] >= 0) continue;
    m_parent[toSize(node)] = node;
    m_members.push_back(node);
  }
  for (int k = 1; k < 4; ++k) m_parent[toSize(find(nodes[0]))] = find(nodes[k]);
}

void GuardGroups::measure(const GuardNodes& nodes) {
  for (const int node : m_members) m_groups[toSize(find(node))] = Group();
  for (const int node : m_members) {
    if (nodes.isImposed(node)) m_groups[toSize(find(node))].isImposed = true;
  }
  for (const int node : m_members) {
    Group& group = m_groups[toSize(find(node))];
    const std::size_t i = toSize(node);
    if (group.isImposed && !nodes.isImposed(node)) continue;
    const double mass = group.isImposed ? 1 : 1 / static_cast<double>(nodes.inverseMass[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      group.sum[k] += mass * static_cast<double>(nodes.to[i].at[k] - nodes.from[i].at[k]);
    }
    group.mass += mass;
  }
}

void GuardGroups::limit(int node, double share) {
  Group& group = m_groups[toSize(find(node))];
  group.share = std::min(group.share, share);
}

void GuardGroups::apply(GuardNodes& nodes) {
  for (const int node : m_members) {
    if (nodes.isImposed(node)) continue;
    const Group& group = m_groups[toSize(find(node))];
    const std::size_t i = toSize(node);
    for (std::size_t k = 0; k < 3; ++k) {
      const double mean = group.sum[k] / group.mass;
      const double way = static_cast<double>(nodes.to[i].at[k]) - static_cast<double>(nodes.from[i].at[k]);
      nodes.to[i].at[k] =
          static_cast<btScalar>(static_cast<double>(nodes.from[i].at[k]) + mean + group.share * (way - mean));
    }
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
