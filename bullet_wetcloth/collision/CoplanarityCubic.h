// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Export.h"
#include "bullet_wetcloth/collision/Query.h"

namespace wetcloth::collision {

/// The cubic whose roots are the times at which the four points of a query are coplanar (the paper's Eq. 8),
/// (p1 - p0)(t) x (p2 - p0)(t) . (p3 - p0)(t), in Bernstein form on [0, 1].
struct WETCLOTH_COLLISION_EXPORT CoplanarityCubic {
  double bernstein[4];  ///< six times the signed volume [length^3]: f(t) = sum_k bernstein[k] C(3,k) t^k (1-t)^(3-k)
  double error;         ///< no coefficient is farther from the exact one of the given points than this

  /// f(t) by de Casteljau's scheme; t in [0, 1].
  double value(double t) const;
  /// True when the exact cubic provably has no root in [0, 1]: its coefficients have one sign, beyond the error.
  bool hasNoRoot() const;
};

/// Eq. 8 for a query of float or double. Coordinates that are not finite, or of which products overflow, give an
/// infinite error.
template <class Scalar>
WETCLOTH_COLLISION_EXPORT CoplanarityCubic coplanarityCubic(const Query<Scalar>& query) noexcept;

}  // namespace wetcloth::collision
