// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/collision/Query.h"

#include <cstddef>
#include <cstdint>

namespace wetcloth::collision {

/// Of the queries queries[indices[0 .. count - 1]], leaves in `indices` those of which single precision could not prove
/// that the four points are never coplanar, in their order, and returns how many. Queries that are not finite stay.
/// Several queries at a time, in SIMD lanes.
template <class Scalar>
std::size_t cullByCubic(const Query<Scalar>* queries, std::uint32_t* indices, std::size_t count);

}  // namespace wetcloth::collision
