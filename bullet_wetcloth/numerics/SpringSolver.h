// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/numerics/FreeParts.h"
#include "bullet_wetcloth/numerics/SparseFactor.h"
#include "bullet_wetcloth/numerics/SpringEnergy.h"

#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

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
/// Minimises SpringEnergy, with y = x0 + dt (v + dt g), by one step of Newton's method from x0 + dt v, or from x0 if E
/// is less there, whose linear equations conjugate gradients solve in a few iterations. They are preconditioned by A^-1
/// + w D^-1: A = M / dt^2 + L, L the springs' weighted Laplacian, is the Hessian if all springs were equally stiff
/// across their length (Liu et al. 2013; without the weakest springs), and reaches through the whole net where it is
/// stiff; D, the Hessian's blocks of 3 x 3, serves the directions in which springs are soft and a node's own inertia
/// decides. The step is halved until E does not rise, whatever the stiffness and the step.
///
/// E has the present masses and forces, so neither the state at rest nor what is conserved depends on A, which is
/// factored only when a node was freed or held, or m / dt^2 of one or the stiffness of a spring is more than twice or
/// less than half of what it was.
class SpringSolver {
 public:
  /// Starts over with a net of that many nodes and springs; forgets the factorisation.
  void reset(std::size_t nodeCount, std::size_t springCount);

  /// Fills velocityChange of the free nodes. Does not allocate while nothing has to be factored anew.
  void solve(const std::vector<Spring>& springs, std::vector<SpringNode>& nodes, double dt, int iterations);

  /// A spring's stiffness has changed since the last call of solve().
  void noteStiffness(const std::vector<Spring>& springs);

  /// Force of all springs on one node at the end of the last step [N].
  std::array<double, 3> forceOn(const std::vector<Spring>& springs, std::size_t node) const;

  /// The factor is made anew of the same numbers. `springs` have their saved stiffness.
  void transferState(StateArchive& archive, const std::vector<Spring>& springs);

  long long factorizations() const { return m_factorizations; }

 private:
  using Vector = SpringEnergy::Vector;
  using Vectors = SpringEnergy::Vectors;

  void start(const std::vector<SpringNode>& nodes, double dt);
  bool mustFactor() const;
  void factor(const std::vector<Spring>& springs);
  void descend(const std::vector<Spring>& springs, int iterations);
  void solveLinearized(int iterations);
  double precondition();

  SpringEnergy m_energy;
  FreeParts m_freeParts;
  Vectors m_positions;
  Vectors m_start;      // of Newton's step
  Vectors m_change;     // the step
  Vectors m_residual;   // of its equations
  Vectors m_direction;  // of conjugate gradients
  Vectors m_preconditioned;
  Vectors m_product;
  Vectors m_work;          // in the order of the factor's rows
  std::vector<int> m_row;  // of a node in the factor, -1 when fixed
  std::vector<double> m_factoredInertia;
  std::vector<double> m_factoredStiffness;
  bool m_hasFactor = false;
  SparseFactor m_factor;
  long long m_factorizations = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
