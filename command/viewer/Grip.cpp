// SPDX-License-Identifier: Zlib
#include "command/viewer/Grip.h"

#include <utility>

namespace viewer {
namespace {

btVector3 atMost(const btVector3& vector, btScalar length) {
  const btScalar own = vector.length();
  return own > length ? btVector3(vector * (length / own)) : vector;
}

/// Of those of its nodes that are free [kg].
btScalar massOf(const btSoftBody& body) {
  btScalar mass = 0;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    if (body.m_nodes[i].m_im > 0) mass += 1 / body.m_nodes[i].m_im;
  }
  return mass;
}

}  // namespace

Grip::Grip(btSoftBody& body, int node, Push push)
    : m_body(body), m_push(std::move(push)), m_nodes{{node, btVector3(0, 0, 0)}}, m_goal(body.m_nodes[node].m_x) {
  const btSoftBody::Node* const gripped = &body.m_nodes[node];
  for (int i = 0; i < body.m_links.size(); ++i) {
    for (int end = 0; end < 2; ++end) {
      if (body.m_links[i].m_n[end] != gripped) continue;
      const btSoftBody::Node* const other = body.m_links[i].m_n[1 - end];
      m_nodes.push_back({static_cast<int>(other - &body.m_nodes[0]), other->m_x - gripped->m_x});
    }
  }
}

void Grip::pull(btScalar dt) {
  const btScalar most = mostVelocityChange(dt);
  for (const Held& held : m_nodes) {
    btSoftBody::Node& node = m_body.m_nodes[held.index];
    const btVector3 wanted = atMost((m_goal + held.offset - node.m_x) / dt, btScalar(fastest));
    m_push(node, atMost(wanted - node.m_v, most));
  }
}

/// The same for all held nodes, so that together they feel no more than the hand's force.
btScalar Grip::mostVelocityChange(btScalar dt) const {
  btScalar heldMass = 0;
  for (const Held& held : m_nodes) {
    const btScalar inverse = m_body.m_nodes[held.index].m_im;
    if (inverse > 0) heldMass += 1 / inverse;
  }
  if (heldMass == 0) return 0;
  return btScalar(timesWeight * usualGravity) * massOf(m_body) / heldMass * dt;
}

}  // namespace viewer
