// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/collision/Query.h"

namespace command::comparison {

/// Tolerant Newton's method, for comparison only: it MISSES contacts.
///
/// The coplanarity cubic is cut into monotone pieces at the roots of its derivative; a piece whose ends differ in sign,
/// or are within the tolerance of zero, is searched by Newton's method safeguarded with bisection; then an inside test
/// with `tolerance` (>= 0, in barycentric weights and in time). In double precision.
template <class Scalar>
wetcloth::collision::Contact newtonCheck(wetcloth::collision::Pair pair,
                                         const wetcloth::collision::Query<Scalar>& query, double tolerance) noexcept;

}  // namespace command::comparison
