// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/collision/PointDifferences.h"

namespace wetcloth::collision {

/// True when floating point with proved error bounds shows that the two meet between t0 and t1 (multiples of 2^-52):
/// the coplanarity cubic changes sign, and the place where the two planes or lines meet is inside both, strictly, all
/// the time. False: not known (a contact on a boundary is never proved).
///
/// The largest component of the motion must be in [2^-100, 2^100].
template <Pair pair>
bool provedContact(const PointDifferences<pair>& start, const PointDifferences<pair>& end, double t0, double t1);

}  // namespace wetcloth::collision
