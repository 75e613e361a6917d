// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/SpringEnergy.h"

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

using Vector = std::array<double, 3>;

// A node's block is k in one direction and m / dt^2 in another; a ratio above this is lost to rounding.
constexpr double kStiffestBlock = 1e10;

Vector difference(const Vector& a, const Vector& b) { return {b[0] - a[0], b[1] - a[1], b[2] - a[2]}; }

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

std::array<double, 3> springForce(const Spring& spring, const Vector& a, const Vector& b) {
  const Vector edge = difference(a, b);
  const double length = std::sqrt(dot(edge, edge));
  const double stiffness = length > 0 ? spring.stiffness * (1 - spring.restLength / length) : 0;
  return {stiffness * edge[0], stiffness * edge[1], stiffness * edge[2]};
}

void SpringEnergy::resize(std::size_t nodeCount, std::size_t springCount) {
  m_inertialPositions.resize(nodeCount);
  m_inertia.resize(nodeCount);
  m_curvatures.resize(springCount);
  m_blocks.resize(nodeCount);
}

void SpringEnergy::setInertia(std::size_t node, const Vector& y, double inertia) {
  m_inertialPositions[node] = y;
  m_inertia[node] = inertia;
}

double SpringEnergy::at(const std::vector<Spring>& springs, const Vectors& positions) const {
  double energy = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vector offset = difference(positions[i], m_inertialPositions[i]);
    energy += m_inertia[i] * dot(offset, offset);
  }
  for (const Spring& spring : springs) {
    const Vector edge =
        difference(positions[static_cast<std::size_t>(spring.a)], positions[static_cast<std::size_t>(spring.b)]);
    const double stretch = std::sqrt(dot(edge, edge)) - spring.restLength;
    energy += spring.stiffness * stretch * stretch;
  }
  return energy / 2;
}

double SpringEnergy::linearize(const std::vector<Spring>& springs, const Vectors& positions, Vectors& force) {
  double energy = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vector offset = difference(positions[i], m_inertialPositions[i]);
    for (std::size_t c = 0; c < 3; ++c) force[i][c] = m_inertia[i] * offset[c];
    energy += m_inertia[i] * dot(offset, offset);
    m_blocks[i] = {m_inertia[i], 0, 0, m_inertia[i], 0, m_inertia[i]};
  }
  for (std::size_t k = 0; k < springs.size(); ++k) {
    const Spring& spring = springs[k];
    const std::size_t a = static_cast<std::size_t>(spring.a);
    const std::size_t b = static_cast<std::size_t>(spring.b);
    const Vector edge = difference(positions[a], positions[b]);
    const double length = std::sqrt(dot(edge, edge));
    const double inverseLength = length > 0 ? 1 / length : 0;
    // Where the ends coincide there is no direction: no force, and as stiff as can be in each.
    const double secant = length > 0 ? spring.stiffness * (1 - spring.restLength * inverseLength) : 0;
    for (std::size_t c = 0; c < 3; ++c) {
      force[a][c] += secant * edge[c];
      force[b][c] -= secant * edge[c];
    }
    energy += spring.stiffness * (length - spring.restLength) * (length - spring.restLength);
    const double across = length > 0 ? std::max(0.0, secant) : spring.stiffness;
    const double along = (spring.stiffness - across) * inverseLength * inverseLength;
    m_curvatures[k] = {spring.a, spring.b, edge, across, along};
    const Block block = {across + along * edge[0] * edge[0], along * edge[0] * edge[1],
                         along * edge[0] * edge[2],          across + along * edge[1] * edge[1],
                         along * edge[1] * edge[2],          across + along * edge[2] * edge[2]};
    for (std::size_t c = 0; c < block.size(); ++c) {
      m_blocks[a][c] += block[c];
      m_blocks[b][c] += block[c];
    }
  }
  for (std::size_t i = 0; i < positions.size(); ++i) m_blocks[i] = m_inertia[i] > 0 ? inverse(m_blocks[i]) : Block{};
  return energy / 2;
}

double SpringEnergy::multiply(const Vectors& p, Vectors& product) const {
  double curvature = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) product[i][c] = m_inertia[i] * p[i][c];
    curvature += m_inertia[i] * dot(p[i], p[i]);
  }
  for (const Curvature& spring : m_curvatures) {
    const std::size_t a = static_cast<std::size_t>(spring.a);
    const std::size_t b = static_cast<std::size_t>(spring.b);
    const Vector change = difference(p[a], p[b]);
    const double lengthening = dot(spring.edge, change);
    curvature += spring.across * dot(change, change) + spring.along * lengthening * lengthening;
    for (std::size_t c = 0; c < 3; ++c) {
      const double force = spring.across * change[c] + spring.along * lengthening * spring.edge[c];
      product[a][c] -= force;
      product[b][c] += force;
    }
  }
  return curvature;
}

SpringEnergy::Vector SpringEnergy::solveBlock(std::size_t node, const Vector& v) const {
  const Block& m = m_blocks[node];
  return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[1] * v[0] + m[3] * v[1] + m[4] * v[2],
          m[2] * v[0] + m[4] * v[1] + m[5] * v[2]};
}

// By cofactors.
SpringEnergy::Block SpringEnergy::inverse(const Block& block) {
  const double least = (block[0] + block[3] + block[5]) / kStiffestBlock;
  const double xx = block[0] + least;
  const double xy = block[1];
  const double xz = block[2];
  const double yy = block[3] + least;
  const double yz = block[4];
  const double zz = block[5] + least;
  const double minorX = yy * zz - yz * yz;
  const double minorY = xz * yz - xy * zz;
  const double minorZ = xy * yz - xz * yy;
  const double scale = 1 / (xx * minorX + xy * minorY + xz * minorZ);
  return {minorX * scale,
          minorY * scale,
          minorZ * scale,
          (xx * zz - xz * xz) * scale,
          (xy * xz - xx * yz) * scale,
          (xx * yy - xy * xy) * scale};
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
