// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/collision/ContinuousCheck.h"
#include "bullet_wetcloth/collision/PointDifferences.h"

namespace wetcloth::collision {

/// What the search ends with: the earliest interval of time in which a contact could not be excluded.
struct Suspicion {
  bool found = false;
  double from = 0;  ///< there is no contact before this
  double to = 0;    ///< the interval's end; 1 when the budget ran out
};

/// Looks for the first contact between two times by excluding intervals (IntervalTest) and dividing the others, the
/// earliest first. The largest component of the motion must be in [2^-100, 2^100].
template <Pair pair>
Suspicion firstSuspicion(const PointDifferences<pair>& start, const PointDifferences<pair>& end,
                         const CheckSettings& settings);

}  // namespace wetcloth::collision
