// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/DropCatcher.h"

#include "bullet_wetcloth/bullet/Layers.h"
#include "bullet_wetcloth/bullet/RequireFaces.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

using Vector = std::array<double, 3>;

Vector doubles(const btVector3& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

Vector difference(const btVector3& a, const btVector3& b) {
  const Vector u = doubles(a);
  const Vector v = doubles(b);
  return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}

// Of a triangle on a plane across `direction`, of length 1 [m^2].
double projectedArea(const btVector3& a, const btVector3& b, const btVector3& c, const btVector3& direction) {
  const Vector u = difference(b, a);
  const Vector v = difference(c, a);
  const Vector d = doubles(direction);
  return std::fabs((u[1] * v[2] - u[2] * v[1]) * d[0] + (u[2] * v[0] - u[0] * v[2]) * d[1] +
                   (u[0] * v[1] - u[1] * v[0]) * d[2]) /
         2;
}

}  // namespace

double caughtFlux(const btVector3& a, const btVector3& b, const btVector3& c, const btVector3& direction, double flux) {
  const double caught = flux * projectedArea(a, b, c, directionOf(direction));
  return std::isfinite(caught) ? caught : 0;
}

void DropCatcher::attach(const char* effect, const btSoftBody& body) {
  requireFaces(effect, body);
  const std::size_t nodes = static_cast<std::size_t>(body.m_nodes.size());
  m_positions.resize(nodes);
  m_drops.resize(nodes);
  m_uptake.reset(nodes);
  m_triangles = layersOf(body);
}

btVector3 DropCatcher::centroid(std::size_t triangle) const {
  const auto corner = [&](std::size_t k) { return m_positions[static_cast<std::size_t>(m_triangles[triangle][k])]; };
  return (corner(0) + corner(1) + corner(2)) / 3;
}

void DropCatcher::begin(const btSoftBody& body) {
  for (std::size_t i = 0; i < m_positions.size(); ++i) m_positions[i] = body.m_nodes[static_cast<int>(i)].m_x;
  std::fill(m_drops.begin(), m_drops.end(), Drops());
  m_caught = 0;
}

void DropCatcher::strike(std::size_t triangle, const btVector3& direction, double perArea, const btVector3& velocity) {
  const Triangle& corners = m_triangles[triangle];
  const auto position = [&](std::size_t k) { return m_positions[static_cast<std::size_t>(corners[k])]; };
  const double third = perArea * projectedArea(position(0), position(1), position(2), direction) / 3;
  const Vector v = doubles(velocity);
  const Vector momentum = {third * v[0], third * v[1], third * v[2]};
  if (!(third > 0 && std::isfinite(third + momentum[0] + momentum[1] + momentum[2]))) return;
  for (const int corner : corners) {
    Drops& drops = m_drops[static_cast<std::size_t>(corner)];
    drops.mass += third;
    for (std::size_t k = 0; k < 3; ++k) drops.momentum[k] += momentum[k];
  }
  m_caught += 3 * third;
}

void DropCatcher::deliver(Water& water, double most) {
  const double share = m_caught > most ? most / m_caught : 1;
  m_caught *= share;
  for (std::size_t i = 0; i < m_drops.size(); ++i) {
    const Drops& drops = m_drops[i];
    if (!(drops.mass > 0)) continue;
    const double vx = drops.momentum[0] / drops.mass;
    const double vy = drops.momentum[1] / drops.mass;
    const double vz = drops.momentum[2] / drops.mass;
    const double rest = m_uptake.catchDrops(water, i, share * drops.mass, vx, vy, vz);
    water.runOff(i, rest, vx, vy, vz);
  }
}

void DropCatcher::transferState(StateArchive& archive) {
  m_uptake.transferState(archive);
  archive.value(m_caught);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
