// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletSoftBody/btSoftBody.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace wetcloth_test {

/// Positions and velocities of all nodes, the numbers themselves.
inline std::vector<btScalar> stateOf(const btSoftBody& body) {
  std::vector<btScalar> state;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      state.push_back(body.m_nodes[i].m_x[axis]);
      state.push_back(body.m_nodes[i].m_v[axis]);
    }
  }
  return state;
}

/// Bit for bit, so that -0 and 0 differ and a NaN equals itself.
inline bool sameBits(const std::vector<btScalar>& a, const std::vector<btScalar>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(btScalar)) == 0);
}

inline double largestDifference(const std::vector<btScalar>& a, const std::vector<btScalar>& b) {
  if (a.size() != b.size()) return HUGE_VAL;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::fabs(double(a[i]) - double(b[i]));
    if (!(difference <= largest)) largest = difference;
  }
  return largest;
}

inline bool isFinite(const btSoftBody& body) {
  const std::vector<btScalar> state = stateOf(body);
  return std::all_of(state.begin(), state.end(), [](btScalar value) { return std::isfinite(value); });
}

/// Gives each node this velocity, in the way that each world takes notice of.
inline void setVelocity(btSoftBody& body, const btVector3& velocity) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    btSoftBody::Node& node = body.m_nodes[i];
    if (node.m_im == 0) continue;
    node.m_v = velocity;
    node.m_vn = velocity;
  }
}

/// Takes a share of all velocities away: lets a scene come to rest without changing where.
inline void damp(btSoftBody& body, double share) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    body.m_nodes[i].m_v *= btScalar(1 - share);
    body.m_nodes[i].m_vn *= btScalar(1 - share);
  }
}

}  // namespace wetcloth_test
