// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/numerics/SparseFactor.h"

#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

struct Spring {
  int a;
  int b;
  double stiffness;   // [N/m]
  double restLength;  // [m]
};

struct SpringNode {
  std::array<double, 3> position;
  std::array<double, 3> velocity;
  std::array<double, 3> acceleration;    // gravity
  std::array<double, 3> velocityChange;  // the answer: what the springs do to the velocity in this step
  double mass;                           // [kg], of free nodes
  bool isFixed;                          // moves with its velocity, whatever the springs do
};

/// Backward Euler for a net of Hooke springs.
///
/// Minimises E(x) = sum m |x - y|^2 / (2 dt^2) + sum k (|x_b - x_a| - l0)^2 / 2 with y = x0 + dt (v + dt g), by
/// x <- x - A^-1 grad E(x) with A = M / dt^2 + L, L the springs' weighted Laplacian. A bounds the Hessian of E from
/// above, so E never rises, for any stiffness and step (Liu et al. 2013; Bouaziz et al. 2014); grad E uses the true
/// masses and forces, so the state at rest does not depend on the number of iterations. A is factored only when the
/// step, the free nodes, a mass by more than 2 %, or a stiffness by more than 5 % has changed; A then bounds the
/// Hessian to 5 %, and E still never rises (that takes a bound of half the Hessian).
class SpringSolver {
 public:
  /// Starts over with a net of that many nodes; forgets the factorisation.
  void reset(std::size_t nodeCount);

  /// Fills velocityChange of the free nodes. Does not allocate while nothing has to be factored anew.
  void solve(const std::vector<Spring>& springs, std::vector<SpringNode>& nodes, double dt, int iterations);

  /// A spring's stiffness has changed since the last call of solve().
  void noteStiffness(const std::vector<Spring>& springs);

  /// Force of all springs on one node at the end of the last step [N].
  std::array<double, 3> springForce(const std::vector<Spring>& springs, std::size_t node) const;

  /// The factor is made anew of the same numbers. `springs` have their saved stiffness.
  void transferState(StateArchive& archive, const std::vector<Spring>& springs);

  long long factorizations() const { return m_factorizations; }

 private:
  using Vector = std::array<double, 3>;

  bool mustFactor(const std::vector<SpringNode>& nodes, double dt) const;
  void factor(const std::vector<Spring>& springs, const std::vector<SpringNode>& nodes, double dt);
  void addSpringForces(const std::vector<Spring>& springs);
  void applyInverse();

  std::vector<Vector> m_positions;  // of the iteration
  std::vector<Vector> m_inertial;   // y
  std::vector<Vector> m_force;      // minus grad E
  std::vector<Vector> m_work;       // in the order of the factor's rows
  std::vector<int> m_row;           // of a node in the factor, -1 when fixed
  std::vector<double> m_factoredMass;
  std::vector<double> m_factoredStiffness;
  double m_factoredDt = 0;
  SparseFactor m_factor;
  long long m_factorizations = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
