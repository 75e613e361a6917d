// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What a glass, a cylinder that is open at the top, holds when it is tilted [m^3]: the water below the level plane
/// through the lowest point of its rim. With t = tan(angle), pi R^2 H - pi R^3 t while that plane cuts the wall all
/// round; then, with c = R - H / t, t (2/3 (R^2 - c^2)^(3/2) - c (R^2 acos(c/R) - c sqrt(R^2 - c^2))); 0 from a quarter
/// turn on.
/// @param radius  R [m], > 0; @param height  H [m], > 0
/// @param cosine  of the angle between the glass's axis and the vertical, [-1, 1]
WETCLOTH_EXPORT double heldInTiltedGlass(double radius, double height, double cosine);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
