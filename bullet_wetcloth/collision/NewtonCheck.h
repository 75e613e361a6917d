// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Export.h"
#include "bullet_wetcloth/collision/Query.h"

namespace wetcloth::collision {

/// Tolerant Newton's method, for comparison only: it MISSES contacts.
///
/// The coplanarity cubic is cut into monotone pieces at the roots of its derivative; a piece whose ends differ in sign,
/// or are within the tolerance of zero, is searched by Newton's method safeguarded with bisection; then an inside test
/// with `tolerance` (>= 0, in barycentric weights and in time). In double precision.
template <class Scalar>
WETCLOTH_COLLISION_EXPORT Contact newtonCheck(Pair pair, const Query<Scalar>& query, double tolerance) noexcept;

}  // namespace wetcloth::collision
