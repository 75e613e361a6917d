// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/ClothGuard.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class PackedCloth;

/// Lists the vertices and faces that touch at the end of a step in btSoftBody::m_scontacts of the vertex's body, in the
/// form in which Bullet lists its own. Both bodies have VF_SS; they may be one. As in Bullet's list there is none
/// between nodes that are all pinned. Places that are nearer than ClothGuard::touching() touch.
/// @param cloths  those that were guarded, in the guard's order
/// @param stepped  so many of them, the first ones, get new lists; a cloth that sleeps keeps its own
void listContacts(const ClothGuard& guard, const std::vector<PackedCloth*>& cloths, std::size_t stepped);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
