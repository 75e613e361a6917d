// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Export.h"
#include "bullet_wetcloth/collision/Query.h"

namespace wetcloth::collision {

/// Whether, and when, the two of a query meet, decided by exact integer arithmetic (Boost.Multiprecision): the doubles
/// of the query are taken for what they are, no rounding anywhere. All coordinates must be finite.
///
/// The returned `time` is a double not later than the exact first time of contact and earlier by at most `tolerance`
/// (in [1e-12, 1]); `where` is left 0.
WETCLOTH_COLLISION_EXPORT Contact exactContact(Pair pair, const Query<double>& query, double tolerance);

}  // namespace wetcloth::collision
