// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/DiffusionSolver.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kShortestWithFactor = 0.8;
constexpr int kMostIterations = 1000;

double dot(const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

}  // namespace

void DiffusionSolver::reset(std::size_t nodeCount) {
  m_work.assign(nodeCount, {0});
  for (auto* array : {&m_uneven, &m_residual, &m_direction, &m_product, &m_diagonal}) array->assign(nodeCount, 0);
  forgetFactor();
}

void DiffusionSolver::factor(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities,
                             double tau) {
  const Eigen::Index size = static_cast<Eigen::Index>(capacities.size());
  std::vector<double> diagonal = capacities;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(capacities.size() + edges.size());
  for (const WeightedEdge& edge : edges) {
    diagonal[toSize(edge.a)] += tau * edge.weight;
    diagonal[toSize(edge.b)] += tau * edge.weight;
    entries.emplace_back(edge.b, edge.a, -tau * edge.weight);  // a < b: below the diagonal
  }
  for (Eigen::Index i = 0; i < size; ++i) entries.emplace_back(i, i, diagonal[static_cast<std::size_t>(i)]);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  m_factor.compute(matrix);
  m_factoredTau = tau;
  ++m_factorizations;
}

// L does not see a constant. Without it a cloth that is nearly even has no rounding error of the constant's size, which
// a long step would turn into a flow.
void DiffusionSolver::setUnevenness(const std::vector<double>& capacities, const std::vector<double>& potential) {
  double sum = 0;
  double capacity = 0;
  for (std::size_t i = 0; i < potential.size(); ++i) {
    sum += capacities[i] * potential[i];
    capacity += capacities[i];
  }
  const double mean = sum / capacity;
  for (std::size_t i = 0; i < potential.size(); ++i) m_uneven[i] = potential[i] - mean;
}

void DiffusionSolver::smoothFactored(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities,
                                     double tau, std::vector<double>& potential) {
  if (!(tau <= m_factoredTau && tau >= kShortestWithFactor * m_factoredTau)) factor(edges, capacities, tau);
  setUnevenness(capacities, potential);
  for (std::size_t i = 0; i < m_uneven.size(); ++i) {
    m_work[toSize(m_factor.row(static_cast<int>(i)))][0] = capacities[i] * m_uneven[i];
  }
  m_factor.solveInPlace(m_work);
  for (std::size_t i = 0; i < potential.size(); ++i) {
    potential[i] = m_work[toSize(m_factor.row(static_cast<int>(i)))][0];
  }
  ++m_solves;
}

void DiffusionSolver::multiply(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities,
                               double tau, const std::vector<double>& x, std::vector<double>& product) const {
  for (std::size_t i = 0; i < x.size(); ++i) product[i] = capacities[i] * x[i];
  for (const WeightedEdge& edge : edges) {
    const double flow = tau * edge.weight * (x[toSize(edge.a)] - x[toSize(edge.b)]);
    product[toSize(edge.a)] += flow;
    product[toSize(edge.b)] -= flow;
  }
}

void DiffusionSolver::smoothIteratively(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities,
                                        double tau, double tolerance, std::vector<double>& potential) {
  ++m_solves;
  setUnevenness(capacities, potential);
  m_diagonal = capacities;
  for (const WeightedEdge& edge : edges) {
    m_diagonal[toSize(edge.a)] += tau * edge.weight;
    m_diagonal[toSize(edge.b)] += tau * edge.weight;
  }
  multiply(edges, capacities, tau, m_uneven, m_product);
  double enough = 0;
  double error = 0;
  double oldError = 0;
  for (std::size_t i = 0; i < m_uneven.size(); ++i) {
    const double wanted = capacities[i] * m_uneven[i];
    m_residual[i] = wanted - m_product[i];
    m_direction[i] = 0;
    enough += wanted * wanted / m_diagonal[i];
    error += m_residual[i] * m_residual[i] / m_diagonal[i];
  }
  enough *= tolerance * tolerance;
  for (int iteration = 0; iteration < kMostIterations && error > enough; ++iteration) {
    const double keep = iteration > 0 ? error / oldError : 0;
    for (std::size_t i = 0; i < m_uneven.size(); ++i) {
      m_direction[i] = m_residual[i] / m_diagonal[i] + keep * m_direction[i];
    }
    multiply(edges, capacities, tau, m_direction, m_product);
    const double length = error / dot(m_direction, m_product);
    oldError = error;
    error = 0;
    for (std::size_t i = 0; i < m_uneven.size(); ++i) {
      m_uneven[i] += length * m_direction[i];
      m_residual[i] -= length * m_product[i];
      error += m_residual[i] * m_residual[i] / m_diagonal[i];
    }
    ++m_iterations;
  }
  std::copy(m_uneven.begin(), m_uneven.end(), potential.begin());
}

double longestExplicitStep(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities) {
  std::vector<double> conductance(capacities.size(), 0);
  for (const WeightedEdge& edge : edges) {
    conductance[toSize(edge.a)] += edge.weight;
    conductance[toSize(edge.b)] += edge.weight;
  }
  double longest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < capacities.size(); ++i) {
    if (conductance[i] > 0) longest = std::min(longest, capacities[i] / conductance[i]);
  }
  return longest;
}

void explicitFluxes(const std::vector<WeightedEdge>& edges, const std::vector<double>& potential, double dt,
                    std::vector<double>& fluxes) {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    fluxes[e] = dt * edges[e].weight * (potential[toSize(edges[e].a)] - potential[toSize(edges[e].b)]);
  }
}

// While a factor is in use the capacities are those that it was made of: see Diffusion::apply().
void DiffusionSolver::transferState(StateArchive& archive, const std::vector<WeightedEdge>& edges,
                                    const std::vector<double>& capacities) {
  archive.value(m_factoredTau);
  if (archive.isRestoring() && m_factoredTau > 0) factor(edges, capacities, m_factoredTau);
  archive.value(m_factorizations, m_solves, m_iterations);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
