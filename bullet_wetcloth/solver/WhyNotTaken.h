// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What a body has that ClothSolver leaves to Bullet's own solver, in words for a message; empty: nothing. That the
/// body collidesWithSoftBodies() is left aside.
const char* whyNotTaken(const btSoftBody& body);
/// By vertices and faces (VF_SS), which is for the guard or for Bullet.
bool collidesWithSoftBodies(const btSoftBody& body);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
