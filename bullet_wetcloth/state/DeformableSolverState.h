// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/state/SoftBodyState.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Before the soft bodies of a deformable world: whether Bullet's solver knows them, as it does from the first step on.
/// It takes them over when that is restored, which computes their normals.
void prepareDeformableSolver(StateArchive& archive, const SoftBodyArray& bodies);

/// After they were: the masses in the solver's preconditioner, which Bullet does not refresh.
void transferDeformableSolver(StateArchive& archive, const SoftBodyArray& bodies);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
