// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/collision/PointDifferences.h"

#include <array>

namespace wetcloth::collision {

/// Where the two are nearest to each other at one time, as in Contact::where: the weights of points 2 and 3 of the
/// face, or the parameters along the two edges. Rounded, always in range; 0 where nothing depends on it.
template <Pair pair>
std::array<double, 2> nearest(const PointDifferences<pair>& at);

}  // namespace wetcloth::collision
