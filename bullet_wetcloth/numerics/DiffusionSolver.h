// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/mesh/IntrinsicDelaunay.h"
#include "bullet_wetcloth/numerics/SparseFactor.h"

#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// Fluxes of one step of C ds/dt = -L Phi(s), C the nodes' capacities, L the Laplacian with conductances G for its
/// weights.
///
/// The implicit step solves (C + dt L) u = C Phi(s) and lets dt G (u_a - u_b) flow along each edge: the nonlinear
/// Chernoff formula s' = s + u - Phi(s) (Berger, Brezis & Rogers 1979, "A numerical method for solving the problem
/// u_t - Delta f(u) = 0"). With Phi(s) = s it is backward Euler. For any dt it conserves water and keeps order:
/// 0 <= s' <= 1, since Phi' <= 1 and C + dt L is an M-matrix; and its matrix does not depend on s.
class DiffusionSolver {
 public:
  /// Starts over with that many nodes. Allocates.
  void reset(std::size_t nodeCount);
  /// Conductances or capacities changed: factors anew at the next step.
  void forgetFactor() { m_factoredDt = 0; }

  /// By a sparse factorisation, which is kept while dt stays the same or is shorter by less than a fifth, so that a
  /// step that jitters from frame to frame does not cost one each time: the matrix then has the longer step, which is
  /// as stable, and of first order, too.
  /// @param edges  weights are conductances [kg/s]; @param capacities [kg]
  /// @param potential  Phi(s) of each node; @param fluxes  the answer: from a to b [kg]
  void solveFactored(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities,
                     const std::vector<double>& potential, double dt, std::vector<double>& fluxes);

  /// By conjugate gradients with Jacobi's preconditioner, from the present state, until the residual is `tolerance`
  /// times that of an even distribution.
  void solveIteratively(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities,
                        const std::vector<double>& potential, double dt, double tolerance, std::vector<double>& fluxes);

  /// The factor is made anew of the same numbers.
  void transferState(StateArchive& archive, const std::vector<WeightedEdge>& edges,
                     const std::vector<double>& capacities);

  long long factorizations() const { return m_factorizations; }
  long long solves() const { return m_solves; }
  /// Of conjugate gradients, all together.
  long long iterations() const { return m_iterations; }

 private:
  void factor(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities, double dt);
  void setUnevenness(const std::vector<double>& capacities, const std::vector<double>& potential);
  void multiply(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities, double dt,
                const std::vector<double>& x, std::vector<double>& product) const;

  SparseFactor m_factor;
  double m_factoredDt = 0;
  std::vector<std::array<double, 1>> m_work;  // in the order of the factor's rows
  std::vector<double> m_uneven;               // potential less its mean, then u less it
  std::vector<double> m_residual;
  std::vector<double> m_direction;
  std::vector<double> m_product;
  std::vector<double> m_diagonal;
  long long m_factorizations = 0;
  long long m_solves = 0;
  long long m_iterations = 0;
};

/// The longest step for which the explicit step s' = s - dt C^-1 L Phi(s) keeps 0 <= s' <= 1 [s]: min C_i / sum_j G_ij.
/// Infinite when nothing is connected.
double longestExplicitStep(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities);

/// Its fluxes from a to b: dt G (Phi_a - Phi_b) [kg].
void explicitFluxes(const std::vector<WeightedEdge>& edges, const std::vector<double>& potential, double dt,
                    std::vector<double>& fluxes);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
