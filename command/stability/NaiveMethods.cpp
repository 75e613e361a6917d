// SPDX-License-Identifier: Zlib
#include "command/stability/NaiveMethods.h"

#include <cmath>
#include <cstddef>

namespace stability::naive {
namespace {

constexpr double kHalfDensity = 0.5 * 1.225;                // rho / 2 of Wind's defaults [kg/m^3]
constexpr double kHalfDensityAndDrag = kHalfDensity * 1.2;  // rho C_d / 2

}  // namespace

std::vector<double> massesOf(const btSoftBody& body) {
  std::vector<double> masses;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const double inverse = double(body.m_nodes[i].m_im);
    masses.push_back(inverse > 0 ? 1 / inverse : 0);
  }
  return masses;
}

void setMasses(btSoftBody& body, const std::vector<double>& dry, double factor) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const double mass = dry[static_cast<std::size_t>(i)];
    if (mass > 0) body.setMass(i, btScalar(mass * factor));
  }
}

void writeMassesOnly(btSoftBody& body, const std::vector<double>& dry, double factor) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const double mass = dry[static_cast<std::size_t>(i)];
    if (mass > 0) body.m_nodes[i].m_im = btScalar(1 / (mass * factor));
  }
}

void writeMassesWithoutMomentum(btSoftBody& body, const std::vector<double>& dry, double factor) {
  writeMassesOnly(body, dry, factor);
  body.updateLinkConstants();
}

void pushByWind(btSoftBody& body, const btVector3& air, double dt) {
  std::vector<btVector3> forces(static_cast<std::size_t>(body.m_nodes.size()), btVector3(0, 0, 0));
  for (int f = 0; f < body.m_faces.size(); ++f) {
    btSoftBody::Node* const* corners = body.m_faces[f].m_n;
    const btVector3 twice = (corners[1]->m_x - corners[0]->m_x).cross(corners[2]->m_x - corners[0]->m_x);
    const btScalar length = twice.length();
    if (!(length > 0)) continue;
    const btVector3 normal = twice / length;
    const btVector3 relative = air - (corners[0]->m_v + corners[1]->m_v + corners[2]->m_v) / 3;
    const btScalar along = relative.dot(normal);
    const btScalar size = btScalar(kHalfDensityAndDrag) * (length / 2) * btFabs(along) * along;
    for (int k = 0; k < 3; ++k) forces[static_cast<std::size_t>(corners[k] - &body.m_nodes[0])] += normal * (size / 3);
  }
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const btVector3 change = forces[static_cast<std::size_t>(i)] * (body.m_nodes[i].m_im * btScalar(dt));
    body.m_nodes[i].m_v += change;
    body.m_nodes[i].m_vn += change;
  }
}

void blowSafely(btSoftBody& body, const btVector3& air, double skinFriction, double dt) {
  const std::size_t count = static_cast<std::size_t>(body.m_nodes.size());
  std::vector<btVector3> forces(count, btVector3(0, 0, 0));
  std::vector<double> drags(count, 0);
  for (int f = 0; f < body.m_faces.size(); ++f) {
    btSoftBody::Node* const* corners = body.m_faces[f].m_n;
    const btVector3 twice = (corners[1]->m_x - corners[0]->m_x).cross(corners[2]->m_x - corners[0]->m_x);
    const btScalar length = twice.length();
    if (!(length > 0)) continue;
    const btVector3 normal = twice / length;
    const btVector3 relative = air - (corners[0]->m_v + corners[1]->m_v + corners[2]->m_v) / 3;
    const btScalar drag = btScalar(kHalfDensityAndDrag) * (length / 6) * btFabs(relative.dot(normal));
    const btScalar slip = (relative - normal * relative.dot(normal)).length();
    const btScalar friction = btScalar(kHalfDensity * skinFriction) * (length / 6) * slip;
    for (int k = 0; k < 3; ++k) {
      const std::size_t corner = static_cast<std::size_t>(corners[k] - &body.m_nodes[0]);
      const btVector3 towards = air - corners[k]->m_v;
      const btScalar along = normal.dot(towards);
      forces[corner] += normal * (drag * along) + (towards - normal * along) * friction;
      drags[corner] += double(drag + friction);
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    btSoftBody::Node& node = body.m_nodes[static_cast<int>(i)];
    const double push = double(node.m_im) * dt;
    const btVector3 change = forces[i] * btScalar(push / (1 + push * drags[i]));
    if (!std::isfinite(double(change.length2()))) continue;
    node.m_v += change;
    node.m_vn += change;
  }
}

}  // namespace stability::naive
