// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/mesh/IntrinsicDelaunay.h"
#include "bullet_wetcloth/numerics/DiffusionSolver.h"
#include "bullet_wetcloth/numerics/FluxLimiter.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Fluxes of one step of C ds/dt = -L Phi(s), of second order in dt: C the nodes' capacities, L the Laplacian with
/// conductances G for its weights, 0 <= Phi' <= 1.
///
/// The Rosenbrock-W method ROS2 (Verwer, Spee, Blom & Hundsdorfer 1999, "A second-order Rosenbrock method applied to
/// photochemical dispersion problems", Eq. 3.1): of second order with any matrix, so with the one for Phi' = 1, which
/// does not depend on s,
///
///     (C + g dt L) u1 = C Phi(s),                s1 = s - dt C^-1 L u1
///     (C + g dt L) u2 = C (Phi(s1) - 2 u1),      s' = s - dt C^-1 L (3 u1 + u2) / 2
///
/// With g = 1 + 1/sqrt(2) it is L-stable, and no mode of any Phi' in [0, 1] changes its sign in a step of any length;
/// with the other root, 1 - 1/sqrt(2), a long step turns the wettest node into the driest of its neighbourhood. s1
/// alone is the nonlinear Chernoff formula (Berger, Brezis & Rogers 1979, "A numerical method for solving the problem
/// u_t - Delta f(u) = 0"), of first order, which keeps order: min s <= s1 <= max s, since C + g dt L is an M-matrix.
/// What the second stage adds to it is limited so that the same holds for s' (Zalesak 1979).
class DiffusionStep {
 public:
  static constexpr double kGamma = 1 + 0.70710678118654752;

  /// For that many nodes and edges. Allocates.
  void reset(std::size_t nodes, std::size_t edges);

  /// @param edges  weights are conductances [kg/s]; @param capacities [kg]; @param saturation  in [0, 1]
  /// @param potential  Phi, a function of a saturation
  /// @param smooth  a function that solves (C + g dt L) u = C p in place of p: see DiffusionSolver. With a matrix of a
  /// somewhat longer step the order and the bounds are the same
  /// @param fluxes  the answer: from a to b of each edge [kg]
  template <class Potential, class Smooth>
  void solve(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities,
             const std::vector<double>& saturation, double dt, Potential potential, Smooth smooth,
             std::vector<double>& fluxes) {
    std::transform(saturation.begin(), saturation.end(), m_first.begin(), potential);
    smooth(m_first);
    explicitFluxes(edges, m_first, dt, fluxes);
    advance(edges, capacities, saturation, fluxes);
    for (std::size_t i = 0; i < m_first.size(); ++i) m_second[i] = potential(m_stage[i]) - 2 * m_first[i];
    smooth(m_second);
    correct(edges, dt, fluxes);
  }

 private:
  void advance(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities,
               const std::vector<double>& saturation, const std::vector<double>& fluxes);
  void correct(const std::vector<WeightedEdge>& edges, double dt, std::vector<double>& fluxes);

  std::vector<double> m_first;        // u1
  std::vector<double> m_second;       // u2
  std::vector<double> m_stage;        // s1
  std::vector<double> m_aboveLowest;  // of s1 [kg]
  std::vector<double> m_range;        // between the lowest and the highest saturation [kg]
  std::vector<double> m_correction;   // of each edge [kg]
  FluxLimiter m_limiter;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
