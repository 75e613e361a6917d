// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletSoftBody/btSoftBody.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace wetcloth_test {

/// Mass of the free nodes as Bullet sees it [kg].
inline double freeMass(const btSoftBody& body) {
  double mass = 0;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    if (body.m_nodes[i].m_im > 0) mass += 1.0 / double(body.m_nodes[i].m_im);
  }
  return mass;
}

/// Momentum of the free nodes [kg m/s].
inline std::array<double, 3> momentum(const btSoftBody& body) {
  std::array<double, 3> sum = {0, 0, 0};
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const btSoftBody::Node& node = body.m_nodes[i];
    if (node.m_im == 0) continue;
    for (int k = 0; k < 3; ++k) sum[std::size_t(k)] += double(node.m_v[k]) / double(node.m_im);
  }
  return sum;
}

/// Centre of mass of the free nodes [m].
inline std::array<double, 3> centreOfMass(const btSoftBody& body) {
  std::array<double, 3> sum = {0, 0, 0};
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const btSoftBody::Node& node = body.m_nodes[i];
    if (node.m_im == 0) continue;
    for (int k = 0; k < 3; ++k) sum[std::size_t(k)] += double(node.m_x[k]) / double(node.m_im);
  }
  for (double& component : sum) component /= freeMass(body);
  return sum;
}

/// Of any node [m/s]; NaN counts as infinite.
inline double largestSpeed(const btSoftBody& body) {
  double largest = 0;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const double speed = double(body.m_nodes[i].m_v.length());
    if (!(speed <= largest)) largest = std::isfinite(speed) ? speed : HUGE_VAL;
  }
  return largest;
}

/// Unweighted mean of the nodes' positions and velocities.
inline btVector3 meanPosition(const btSoftBody& body) {
  btVector3 sum(0, 0, 0);
  for (int i = 0; i < body.m_nodes.size(); ++i) sum += body.m_nodes[i].m_x;
  return sum / btScalar(body.m_nodes.size());
}
inline btVector3 meanVelocity(const btSoftBody& body) {
  btVector3 sum(0, 0, 0);
  for (int i = 0; i < body.m_nodes.size(); ++i) sum += body.m_nodes[i].m_v;
  return sum / btScalar(body.m_nodes.size());
}

/// Sum over links of length and of rest length [m].
inline double totalLength(const btSoftBody& body) {
  double sum = 0;
  for (int i = 0; i < body.m_links.size(); ++i) {
    const btSoftBody::Link& link = body.m_links[i];
    sum += double((link.m_n[0]->m_x - link.m_n[1]->m_x).length());
  }
  return sum;
}
inline double totalRestLength(const btSoftBody& body) {
  double sum = 0;
  for (int i = 0; i < body.m_links.size(); ++i) sum += double(body.m_links[i].m_rl);
  return sum;
}

}  // namespace wetcloth_test
