// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btVector3.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A vector's length, also where its square is too large or too small for Bullet's scalar.
WETCLOTH_EXPORT double lengthOf(const btVector3& vector);

/// A vector's direction, length 1, whatever its length; zero for a vector of length 0 or one that is not finite.
WETCLOTH_EXPORT btVector3 directionOf(const btVector3& vector);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
