// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/GuardNodes.h"
#include "bullet_wetcloth/solver/GuardPlanes.h"

#include <optional>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A plane that is between the two parts of a pair both where they were and where they are, if one is found: parts that
/// turn together leave the sides of a plane that does not turn with them, although they do not meet.
///
/// Its gap and places are those at the end of the small step before.
/// @param first  how many nodes are of the first part
/// @param least  the gap has to be more at both ends, in double [m]
std::optional<GuardPlanes::Plane> turnedPlane(const GuardPair& pair, const GuardNodes& nodes, int first, double least);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
