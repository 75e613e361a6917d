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
    m_contacts.assign(nodes, Contact());
  }
  for (const int node : m_members) {
    m_parent[toSize(node)] = -1;
    m_contacts[toSize(node)].count = 0;
  }
  m_members.clear();
  m_hasContacts = false;
}

int GuardGroups::find(int node) {
  while (m_parent[toSize(node)] != node) {
    m_parent[toSize(node)] = m_parent[toSize(m_parent[toSize(node)])];
    node = m_parent[toSize(node)];
  }
  return node;
}

void GuardGroups::join(const GuardNodes& nodes, const GuardPlanes& planes, std::size_t plane) {
  Contact contact = {};
  btScalar sum = 0;
  int first = -1;
  for (int k = 0; k < 4; ++k) {
    const int node = planes.node(plane, k);
    if (nodes.isOfBodies(node)) {
      contact.bodyNode[contact.count] = node;
      contact.weight[contact.count++] = planes.weight(plane, k);
      sum += planes.weight(plane, k);
      continue;
    }
    if (m_parent[toSize(node)] < 0) {
      m_parent[toSize(node)] = node;
      m_members.push_back(node);
    }
    if (first >= 0) m_parent[toSize(find(first))] = find(node);
    if (first < 0) first = node;
  }
  if (contact.count == 0) return;
  m_hasContacts = true;
  for (int k = 0; k < contact.count; ++k) contact.weight[k] /= sum;
  for (int k = 0; k < 4; ++k) {
    const int node = planes.node(plane, k);
    if (!nodes.isOfBodies(node)) m_contacts[toSize(node)] = contact;
  }
}

// Of the place of the body.
double GuardGroups::wayOf(const Contact& contact, const GuardNodes& nodes, std::size_t axis) {
  double way = 0;
  for (int k = 0; k < contact.count; ++k) {
    const std::size_t body = toSize(contact.bodyNode[k]);
    way += static_cast<double>(contact.weight[k]) *
           static_cast<double>(nodes.to[body].at[axis] - nodes.from[body].at[axis]);
  }
  return way;
}

void GuardGroups::measure(const GuardNodes& nodes) {
  for (const int node : m_members) m_groups[toSize(find(node))] = Group();
  for (const int node : m_members) {
    if (nodes.isImposed(node) || m_contacts[toSize(node)].count > 0) m_groups[toSize(find(node))].isImposed = true;
  }
  for (const int node : m_members) {
    Group& group = m_groups[toSize(find(node))];
    const std::size_t i = toSize(node);
    const Contact& contact = m_contacts[i];
    if (contact.count > 0) {
      for (std::size_t axis = 0; axis < 3; ++axis) group.sum[axis] += wayOf(contact, nodes, axis);
      group.mass += 1;
    }
    if (group.isImposed && !nodes.isImposed(node)) continue;
    const double mass = group.isImposed ? 1 : 1 / static_cast<double>(nodes.inverseMass[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      group.sum[k] += mass * static_cast<double>(nodes.to[i].at[k] - nodes.from[i].at[k]);
    }
    group.mass += mass;
  }
}

void GuardGroups::limit(const GuardNodes& nodes, const GuardPlanes& planes, std::size_t plane, double share) {
  int which = 0;
  while (nodes.isOfBodies(planes.node(plane, which))) ++which;
  Group& group = m_groups[toSize(find(planes.node(plane, which)))];
  group.share = std::min(group.share, share);
}

void GuardGroups::apply(GuardNodes& nodes, bool eachByItself) {
  for (const int node : m_members) {
    if (nodes.isImposed(node)) continue;
    Group& group = m_groups[toSize(find(node))];
    const std::size_t i = toSize(node);
    btVector3 change;
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t k = toSize(axis);
      const bool isByItself = eachByItself && m_contacts[i].count > 0;
      const double mean = isByItself ? wayOf(m_contacts[i], nodes, k) : group.sum[k] / group.mass;
      const double way = static_cast<double>(nodes.to[i].at[k]) - static_cast<double>(nodes.from[i].at[k]);
      const btScalar place =
          static_cast<btScalar>(static_cast<double>(nodes.from[i].at[k]) + mean + group.share * (way - mean));
      change[axis] = place - nodes.to[i].at[k];
      nodes.to[i].at[k] = place;
    }
    group.gain += change / nodes.inverseMass[i];
    group.way += change.length2() / nodes.inverseMass[i];
    if (m_contacts[i].count > 0) ++group.contacts;
  }
  if (m_hasContacts) recoil(nodes);
}

// What a group has gained comes from the bodies that touch it.
void GuardGroups::recoil(GuardNodes& nodes) {
  for (const int node : m_members) {
    const Contact& contact = m_contacts[toSize(node)];
    const Group& group = m_groups[toSize(find(node))];
    if (contact.count == 0 || nodes.isImposed(node)) continue;
    const btScalar size = group.gain.length();
    if (!(size > 0)) continue;
    for (int k = 0; k < contact.count; ++k) {
      const btScalar share = contact.weight[k] / static_cast<btScalar>(group.contacts);
      nodes.addRecoil(contact.bodyNode[k], group.gain * share, group.way / size);
    }
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
