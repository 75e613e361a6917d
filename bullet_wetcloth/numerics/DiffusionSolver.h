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

/// Smooths a potential over the nodes: solves (C + tau L) u = C p, C the nodes' capacities, L the Laplacian with
/// conductances for its weights. u lies between the least and the greatest p, since C + tau L is an M-matrix.
class DiffusionSolver {
 public:
  /// Starts over with that many nodes. Allocates.
  void reset(std::size_t nodeCount);
  /// Conductances or capacities changed: factors anew at the next step.
  void forgetFactor() { m_factoredTau = 0; }

  /// By a sparse factorisation, which is kept while tau stays the same or is shorter by less than a fifth, so that a
  /// step that jitters from frame to frame does not cost one each time: the matrix then has the longer tau, with which
  /// DiffusionStep is as stable and of the same order.
  /// @param edges  weights are conductances [kg/s]; @param capacities [kg]
  /// @param potential  p of each node, and afterwards u but for a constant, which drives no flow
  void smoothFactored(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities, double tau,
                      std::vector<double>& potential);

  /// By conjugate gradients with Jacobi's preconditioner, from p, until the residual is `tolerance` times that of an
  /// even distribution.
  void smoothIteratively(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities, double tau,
                         double tolerance, std::vector<double>& potential);

  /// The factor is made anew of the same numbers.
  void transferState(StateArchive& archive, const std::vector<WeightedEdge>& edges,
                     const std::vector<double>& capacities);

  long long factorizations() const { return m_factorizations; }
  long long solves() const { return m_solves; }
  /// Of conjugate gradients, all together.
  long long iterations() const { return m_iterations; }

 private:
  void factor(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities, double tau);
  void setUnevenness(const std::vector<double>& capacities, const std::vector<double>& potential);
  void multiply(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities, double tau,
                const std::vector<double>& x, std::vector<double>& product) const;

  SparseFactor m_factor;
  double m_factoredTau = 0;
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
