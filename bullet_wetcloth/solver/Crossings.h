// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/ClothGuard.h"

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// How many pairs of an edge and a face go through each other where these cloths are now, of one cloth or of two. What
/// shares a node is no pair. Computed in double; what only touches may count or not.
long long crossingsOf(const std::vector<ClothGuard::Cloth>& cloths);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
