// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/SpringSolver.h"

#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kMassChange = 0.02;  // an error e of A's masses leaves e^iterations of the motion unresolved
constexpr double kStiffnessChange = 0.05;

// K (|b - a| - l0) along b - a, the force on a.
std::array<double, 3> pull(const std::array<double, 3>& a, const std::array<double, 3>& b, const Spring& spring) {
  const double x = b[0] - a[0];
  const double y = b[1] - a[1];
  const double z = b[2] - a[2];
  const double length = std::sqrt(x * x + y * y + z * z);
  const double factor = length > 0 ? spring.stiffness * (1 - spring.restLength / length) : 0;
  return {factor * x, factor * y, factor * z};
}

}  // namespace

void SpringSolver::reset(std::size_t nodeCount) {
  m_positions.resize(nodeCount);
  m_inertial.resize(nodeCount);
  m_force.resize(nodeCount);
  m_row.assign(nodeCount, -1);
  m_factoredMass.assign(nodeCount, 0);
  m_factoredStiffness.clear();
  m_factoredDt = 0;
}

void SpringSolver::noteStiffness(const std::vector<Spring>& springs) {
  const auto isClose = [](const Spring& spring, double factored) {
    return std::fabs(spring.stiffness - factored) <= kStiffnessChange * factored;
  };
  if (!std::equal(springs.begin(), springs.end(), m_factoredStiffness.begin(), m_factoredStiffness.end(), isClose)) {
    m_factoredDt = 0;
  }
}

void SpringSolver::solve(const std::vector<Spring>& springs, std::vector<SpringNode>& nodes, double dt,
                         int iterations) {
  if (mustFactor(nodes, dt)) factor(springs, nodes, dt);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      // From here a cloth at rest has nothing left to solve, and it stays at rest.
      m_positions[i][c] = nodes[i].position[c] + dt * nodes[i].velocity[c];
      m_inertial[i][c] = m_positions[i][c] + dt * dt * nodes[i].acceleration[c];
    }
  }
  for (int iteration = 0; iteration < iterations; ++iteration) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double inertia = nodes[i].mass / (dt * dt);
      for (std::size_t c = 0; c < 3; ++c) m_force[i][c] = inertia * (m_inertial[i][c] - m_positions[i][c]);
    }
    addSpringForces(springs);
    applyInverse();
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      nodes[i].velocityChange[c] = (m_positions[i][c] - m_inertial[i][c]) / dt;
    }
  }
}

void SpringSolver::addSpringForces(const std::vector<Spring>& springs) {
  for (const Spring& spring : springs) {
    const std::size_t a = static_cast<std::size_t>(spring.a);
    const std::size_t b = static_cast<std::size_t>(spring.b);
    const Vector force = pull(m_positions[a], m_positions[b], spring);
    for (std::size_t c = 0; c < 3; ++c) {
      m_force[a][c] += force[c];
      m_force[b][c] -= force[c];
    }
  }
}

std::array<double, 3> SpringSolver::springForce(const std::vector<Spring>& springs, std::size_t node) const {
  Vector total = {0, 0, 0};
  for (const Spring& spring : springs) {
    const std::size_t a = static_cast<std::size_t>(spring.a);
    const std::size_t b = static_cast<std::size_t>(spring.b);
    if (a != node && b != node) continue;
    const Vector force = pull(m_positions[a], m_positions[b], spring);
    for (std::size_t c = 0; c < 3; ++c) total[c] += a == node ? force[c] : -force[c];
  }
  return total;
}

bool SpringSolver::mustFactor(const std::vector<SpringNode>& nodes, double dt) const {
  if (dt != m_factoredDt) return true;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].isFixed != (m_row[i] < 0)) return true;
    if (!nodes[i].isFixed && std::fabs(nodes[i].mass - m_factoredMass[i]) > kMassChange * m_factoredMass[i]) {
      return true;
    }
  }
  return false;
}

void SpringSolver::factor(const std::vector<Spring>& springs, const std::vector<SpringNode>& nodes, double dt) {
  int rows = 0;
  std::vector<int> unknown(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!nodes[i].isFixed) unknown[i] = rows++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(nodes.size() + 4 * springs.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    m_factoredMass[i] = nodes[i].mass;
    if (unknown[i] >= 0) entries.emplace_back(unknown[i], unknown[i], nodes[i].mass / (dt * dt));
  }
  m_factoredStiffness.resize(springs.size());
  std::transform(springs.begin(), springs.end(), m_factoredStiffness.begin(),
                 [](const Spring& spring) { return spring.stiffness; });
  for (const Spring& spring : springs) {
    const int a = unknown[static_cast<std::size_t>(spring.a)];
    const int b = unknown[static_cast<std::size_t>(spring.b)];
    if (a >= 0) entries.emplace_back(a, a, spring.stiffness);
    if (b >= 0) entries.emplace_back(b, b, spring.stiffness);
    if (a >= 0 && b >= 0) entries.emplace_back(std::max(a, b), std::min(a, b), -spring.stiffness);
  }
  Eigen::SparseMatrix<double> matrix(rows, rows);
  matrix.setFromTriplets(entries.begin(), entries.end());
  m_factor.compute(matrix);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    m_row[i] = unknown[i] >= 0 ? m_factor.row(unknown[i]) : -1;
  }
  m_work.resize(static_cast<std::size_t>(rows));
  m_factoredDt = dt;
  ++m_factorizations;
}

// positions += A^-1 force on the free nodes.
void SpringSolver::applyInverse() {
  for (std::size_t i = 0; i < m_row.size(); ++i) {
    if (m_row[i] >= 0) m_work[static_cast<std::size_t>(m_row[i])] = m_force[i];
  }
  m_factor.solveInPlace(m_work);
  for (std::size_t i = 0; i < m_row.size(); ++i) {
    if (m_row[i] < 0) continue;
    for (std::size_t c = 0; c < 3; ++c) m_positions[i][c] += m_work[static_cast<std::size_t>(m_row[i])][c];
  }
}

// The factor may be older than masses and stiffness are, so what it was made of is saved.
void SpringSolver::transferState(StateArchive& archive, const std::vector<Spring>& springs) {
  std::vector<Spring> factored = springs;
  std::vector<SpringNode> nodes(m_row.size());
  double dt = m_factoredDt;
  archive.local(dt);
  const bool hasFactor = dt > 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    unsigned char isFixed = m_row[i] < 0 ? 1 : 0;
    nodes[i].mass = m_factoredMass[i];
    archive.local(isFixed);
    archive.local(nodes[i].mass);
    nodes[i].isFixed = isFixed != 0;
  }
  for (std::size_t k = 0; hasFactor && k < factored.size(); ++k) {
    if (archive.isSaving()) factored[k].stiffness = m_factoredStiffness[k];
    archive.local(factored[k].stiffness);
  }
  if (archive.isRestoring()) m_factoredDt = 0;
  if (archive.isRestoring() && hasFactor) factor(factored, nodes, dt);
  archive.value(m_factorizations);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
