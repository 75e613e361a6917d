// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btScalar.h>

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// How wetness changes what a cloth does to layers that it touches, by node. What is empty is as of a dry one.
struct LayerWetness {
  std::vector<btScalar> friction;  ///< the guard's coefficient times this, >= 0
  std::vector<btScalar> pull;      ///< that keeps it on the layer on each of its two sides [N], >= 0
  std::vector<btScalar> shear;     ///< that keeps it in its place along that layer [N], >= 0
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
