// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/state/SoftBodyState.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Bullet's caches of distances to convex shapes (btSoftBodyWorldInfo::m_sparsesdf): the size of their cells, which are
/// given up and computed anew from the shapes as they are. So these have to be what they were when Bullet measured
/// them: throws StateError while saving when one was changed since, and Bullet still goes by the old one.
void transferDistanceCaches(StateArchive& archive, btCollisionWorld& world, const SoftBodyArray& bodies);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
