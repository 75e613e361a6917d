// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/collision/Query.h"

namespace wetcloth::collision {

/// True when all differences between a point of one primitive and a point of the other, at times 0 and 1, are on one
/// side of an axis plane: proves that the two do not meet. Also proves that all coordinates are finite.
///
/// The difference of two numbers never has the wrong sign when it is rounded, so this needs no error bound.
template <Pair pair, class Scalar>
bool apartOnAnAxis(const Query<Scalar>& query);

}  // namespace wetcloth::collision
