// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

struct Spring {
  int a;
  int b;
  double stiffness;   // [N/m]
  double restLength;  // [m]
};

/// Force on end `a` of a spring, whose ends are at these places [N]. Zero when they coincide.
std::array<double, 3> springForce(const Spring& spring, const std::array<double, 3>& a, const std::array<double, 3>& b);

/// What backward Euler minimises for a net of springs:
///
///   E(x) = sum m |x - y|^2 / (2 dt^2) + sum k (|x_b - x_a| - l0)^2 / 2,
///
/// and its Hessian, without what makes it indefinite: a spring of length l along the unit vector n counts for
/// k n n^T + k max(0, 1 - l0 / l) (I - n n^T), so a compressed one does not push sideways (Choi and Ko 2002).
class SpringEnergy {
 public:
  using Vector = std::array<double, 3>;
  using Vectors = std::vector<Vector>;

  /// For a net of that many nodes and springs.
  void resize(std::size_t nodeCount, std::size_t springCount);

  /// y [m] and m / dt^2 [N/m] of a node; 0 for one that does not move.
  void setInertia(std::size_t node, const Vector& y, double inertia);
  std::size_t size() const { return m_inertia.size(); }  ///< nodes
  const Vector& inertialPosition(std::size_t node) const { return m_inertialPositions[node]; }
  double inertia(std::size_t node) const { return m_inertia[node]; }

  /// E at `positions` [J].
  double at(const std::vector<Spring>& springs, const Vectors& positions) const;

  /// E at `positions`, whose Hessian the functions below take. Fills `force`, which is -grad E. That of a node that
  /// does not move means nothing.
  double linearize(const std::vector<Spring>& springs, const Vectors& positions, Vectors& force);
  /// Fills `product` with the Hessian times p; p is 0 where nothing moves. Returns p^T (Hessian) p.
  double multiply(const Vectors& p, Vectors& product) const;
  /// The inverse of the node's own block of the Hessian, times v; 0 for a node that does not move.
  Vector solveBlock(std::size_t node, const Vector& v) const;

 private:
  /// xx, xy, xz, yy, yz, zz of a symmetric matrix.
  using Block = std::array<double, 6>;
  /// A spring's Hessian: across I + along edge edge^T.
  struct Curvature {
    int a;
    int b;
    Vector edge;    // [m]
    double across;  // [N/m]
    double along;   // [N/m^3]
  };

  static Block inverse(const Block& block);

  Vectors m_inertialPositions;
  std::vector<double> m_inertia;
  std::vector<Curvature> m_curvatures;
  std::vector<Block> m_blocks;  // inverted, of the nodes
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
