// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/collision/Query.h"

namespace command::comparison {

/// The closed form of the textbooks, for comparison only: it MISSES contacts.
///
/// Roots of the coplanarity cubic by Cardano's formula, then an inside test at each. Rounding loses double roots, roots
/// at the ends of the motion, and whatever is coplanar all along.
/// `tolerance` (>= 0) is how far outside [0, 1], the face or the edges (in barycentric weights) still counts; 0 is the
/// strict inside test. Scalar (float or double) is the precision that all of it is done in.
template <class Scalar>
wetcloth::collision::Contact textbookCheck(wetcloth::collision::Pair pair,
                                           const wetcloth::collision::Query<Scalar>& query, Scalar tolerance) noexcept;

}  // namespace command::comparison
