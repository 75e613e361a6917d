// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

namespace command {

/// The stiffest springs along a body's links that Bullet's explicit deformable world bears with a margin, all alike
/// [N/m]: the fastest mode of masses and springs as they lie, of eigenvalue w^2, has w dt = sqrt(1.5), where 2 is the
/// end of stability (Courant, Friedrichs & Lewy 1928; links that line up as the cloth folds raise w^2 to at most
/// twice). About 0.15 times the lightest mass over dt^2. Infinite without links between free nodes.
/// @param substep  dt [s], > 0
double stableStiffness(const btSoftBody& body, double substep);

/// The springs of a cloth: what the scene says; else 100 N/m and 1 N/m against bending, or less where the explicit
/// world does not bear that. Throws std::invalid_argument for one beside which the lightest node's mass is lost in
/// btScalar: Bullet's solver would stop, and the cloth would hang in the air.
DeformableSprings springsOf(const SpringScene& scene, const btSoftBody& body, double substep, bool isImplicit);

}  // namespace command
