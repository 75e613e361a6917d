// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/SpringSolver.h"

#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kStaleRatio = 2;  // a worse preconditioner costs accuracy by the root of this; a new one, many steps
constexpr double kBlockWeight = 0.3;  // w: 0.15 to 0.5 do alike
constexpr double kRounding = 1e-12;   // of E
constexpr double kWeak = 0.005;       // of what else holds both ends
constexpr double kSolved = 1e-20;     // of the slope: the square of what is left, which then is rounding
constexpr int kHalvings = 20;

bool isStale(double present, double factored) {
  return present > kStaleRatio * factored || factored > kStaleRatio * present;
}

/// M / dt^2 + L in the rows `unknown` of the nodes; its lower triangle. A spring much weaker than the others at both
/// its ends is left out: it is between nodes that are not neighbours, as a rule, and half of what the factor would hold
/// is due to those.
Eigen::SparseMatrix<double> laplacian(const std::vector<Spring>& springs, const std::vector<double>& inertia,
                                      const std::vector<int>& unknown, int rows) {
  std::vector<double> hold(unknown.size(), 0);
  for (const Spring& spring : springs) {
    hold[static_cast<std::size_t>(spring.a)] += spring.stiffness;
    hold[static_cast<std::size_t>(spring.b)] += spring.stiffness;
  }
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(unknown.size() + 3 * springs.size());
  for (std::size_t i = 0; i < unknown.size(); ++i) {
    if (unknown[i] >= 0) entries.emplace_back(unknown[i], unknown[i], inertia[i]);
  }
  for (const Spring& spring : springs) {
    const std::size_t a = static_cast<std::size_t>(spring.a);
    const std::size_t b = static_cast<std::size_t>(spring.b);
    if (spring.stiffness < kWeak * std::min(hold[a], hold[b])) continue;
    if (unknown[a] >= 0) entries.emplace_back(unknown[a], unknown[a], spring.stiffness);
    if (unknown[b] >= 0) entries.emplace_back(unknown[b], unknown[b], spring.stiffness);
    if (unknown[a] < 0 || unknown[b] < 0) continue;
    entries.emplace_back(std::max(unknown[a], unknown[b]), std::min(unknown[a], unknown[b]), -spring.stiffness);
  }
  Eigen::SparseMatrix<double> matrix(rows, rows);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

void SpringSolver::reset(std::size_t nodeCount, std::size_t springCount) {
  m_energy.resize(nodeCount, springCount);
  for (Vectors* vectors :
       {&m_positions, &m_start, &m_change, &m_residual, &m_direction, &m_preconditioned, &m_product}) {
    vectors->resize(nodeCount);
  }
  m_row.assign(nodeCount, -1);
  m_factoredInertia.assign(nodeCount, 0);
  m_factoredStiffness.assign(springCount, 0);
  m_hasFactor = false;
}

void SpringSolver::noteStiffness(const std::vector<Spring>& springs) {
  const auto isFresh = [](const Spring& spring, double factored) { return !isStale(spring.stiffness, factored); };
  if (!std::equal(springs.begin(), springs.end(), m_factoredStiffness.begin(), isFresh)) m_hasFactor = false;
}

void SpringSolver::solve(const std::vector<Spring>& springs, std::vector<SpringNode>& nodes, double dt,
                         int iterations) {
  start(nodes, dt);
  if (mustFactor()) factor(springs);
  m_freeParts.centre(m_energy, m_positions);
  descend(springs, iterations);
  m_freeParts.centre(m_energy, m_positions);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      nodes[i].velocityChange[c] = (m_positions[i][c] - m_energy.inertialPosition(i)[c]) / dt;
    }
  }
}

// From x0 + dt v, where a cloth at rest has nothing left to solve, and stays at rest; from x0 if springs would be far
// too long or short there. E(x0) is the energy of the last step, which then is a bound of the next one's.
void SpringSolver::start(const std::vector<SpringNode>& nodes, double dt) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Vector inertial;
    for (std::size_t c = 0; c < 3; ++c) {
      m_positions[i][c] = nodes[i].position[c] + dt * nodes[i].velocity[c];
      m_start[i][c] = nodes[i].isFixed ? m_positions[i][c] : nodes[i].position[c];
      inertial[c] = m_positions[i][c] + dt * dt * nodes[i].acceleration[c];
    }
    m_energy.setInertia(i, inertial, nodes[i].isFixed ? 0 : nodes[i].mass / (dt * dt));
  }
}

// One step of Newton's method, or as much of it as does not raise E.
void SpringSolver::descend(const std::vector<Spring>& springs, int iterations) {
  double energy = m_energy.linearize(springs, m_positions, m_residual);
  if (m_energy.at(springs, m_start) < energy) {
    m_positions = m_start;
    energy = m_energy.linearize(springs, m_positions, m_residual);
  }
  solveLinearized(iterations);
  m_start = m_positions;
  double share = 1;
  for (int halving = 0; halving <= kHalvings; ++halving) {
    for (std::size_t i = 0; i < m_positions.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) m_positions[i][c] = m_start[i][c] + share * m_change[i][c];
    }
    if (m_energy.at(springs, m_positions) <= energy * (1 + kRounding)) return;
    share /= 2;
  }
  m_positions = m_start;
}

// Hessian change = residual, by conjugate gradients.
void SpringSolver::solveLinearized(int iterations) {
  std::fill(m_change.begin(), m_change.end(), Vector{});
  std::fill(m_direction.begin(), m_direction.end(), Vector{});
  double previous = 1;
  double least = 0;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const double slope = precondition();
    if (iteration == 0) least = kSolved * slope;
    if (!(slope > least)) break;
    const double kept = slope / previous;
    previous = slope;
    for (std::size_t i = 0; i < m_direction.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) m_direction[i][c] = m_preconditioned[i][c] + kept * m_direction[i][c];
    }
    const double step = slope / m_energy.multiply(m_direction, m_product);
    for (std::size_t i = 0; i < m_change.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        m_change[i][c] += step * m_direction[i][c];
        m_residual[i][c] -= step * m_product[i][c];
      }
    }
  }
}

// Returns residual . preconditioned.
double SpringSolver::precondition() {
  for (std::size_t i = 0; i < m_row.size(); ++i) {
    if (m_row[i] >= 0) m_work[static_cast<std::size_t>(m_row[i])] = m_residual[i];
  }
  m_factor.solveInPlace(m_work);
  double product = 0;
  for (std::size_t i = 0; i < m_row.size(); ++i) {
    if (m_row[i] < 0) {
      m_preconditioned[i] = Vector{};
      continue;
    }
    const Vector& global = m_work[static_cast<std::size_t>(m_row[i])];
    const Vector own = m_energy.solveBlock(i, m_residual[i]);
    for (std::size_t c = 0; c < 3; ++c) {
      m_preconditioned[i][c] = global[c] + kBlockWeight * own[c];
      product += m_residual[i][c] * m_preconditioned[i][c];
    }
  }
  return product;
}

std::array<double, 3> SpringSolver::forceOn(const std::vector<Spring>& springs, std::size_t node) const {
  Vector total = {0, 0, 0};
  for (const Spring& spring : springs) {
    const std::size_t a = static_cast<std::size_t>(spring.a);
    const std::size_t b = static_cast<std::size_t>(spring.b);
    if (a != node && b != node) continue;
    const Vector force = springForce(spring, m_positions[a], m_positions[b]);
    for (std::size_t c = 0; c < 3; ++c) total[c] += a == node ? force[c] : -force[c];
  }
  return total;
}

bool SpringSolver::mustFactor() const {
  if (!m_hasFactor) return true;
  for (std::size_t i = 0; i < m_row.size(); ++i) {
    // 0 of what is held, and nothing is within a ratio of that but 0.
    if (isStale(m_energy.inertia(i), m_factoredInertia[i])) return true;
  }
  return false;
}

void SpringSolver::factor(const std::vector<Spring>& springs) {
  int rows = 0;
  std::vector<int> unknown(m_row.size(), -1);
  for (std::size_t i = 0; i < m_row.size(); ++i) {
    m_factoredInertia[i] = m_energy.inertia(i);
    if (m_factoredInertia[i] > 0) unknown[i] = rows++;
  }
  std::transform(springs.begin(), springs.end(), m_factoredStiffness.begin(),
                 [](const Spring& spring) { return spring.stiffness; });
  m_factor.compute(laplacian(springs, m_factoredInertia, unknown, rows));
  for (std::size_t i = 0; i < m_row.size(); ++i) m_row[i] = unknown[i] >= 0 ? m_factor.row(unknown[i]) : -1;
  m_work.resize(static_cast<std::size_t>(rows));
  m_freeParts.find(springs, m_energy);
  m_hasFactor = true;
  ++m_factorizations;
}

// The factor may be older than masses and stiffness are, so what it was made of is saved.
void SpringSolver::transferState(StateArchive& archive, const std::vector<Spring>& springs) {
  std::vector<Spring> factored = springs;
  unsigned char hasFactor = m_hasFactor ? 1 : 0;
  archive.local(hasFactor);
  std::vector<double> inertia = m_factoredInertia;
  for (double& value : inertia) archive.local(value);
  for (std::size_t k = 0; hasFactor != 0 && k < factored.size(); ++k) {
    if (archive.isSaving()) factored[k].stiffness = m_factoredStiffness[k];
    archive.local(factored[k].stiffness);
  }
  if (archive.isRestoring()) {
    m_hasFactor = false;
    for (std::size_t i = 0; i < inertia.size(); ++i) m_energy.setInertia(i, Vector{}, inertia[i]);
    if (hasFactor != 0) factor(factored);
  }
  archive.value(m_factorizations);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
