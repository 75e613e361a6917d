// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletSoftBody/btSoftBody.h>

#include <vector>

/// What one would write first to make a plain btSoftBody wet, and what this library does not do.
namespace stability::naive {

/// Dry masses of all nodes [kg], 0 for pinned ones.
std::vector<double> massesOf(const btSoftBody& body);

/// btSoftBody::setMass() on every free node, in every step: Bullet then resets the rest lengths.
void setMasses(btSoftBody& body, const std::vector<double>& dry, double factor);

/// Writes the inverse masses and leaves Bullet's link constants as they were.
void writeMassesOnly(btSoftBody& body, const std::vector<double>& dry, double factor);

/// Writes inverse masses and link constants, as it should be, but no momentum comes with the water.
void writeMassesWithoutMomentum(btSoftBody& body, const std::vector<double>& dry, double factor);

/// The quadratic law of Wind::Law::quadratic, 1/2 rho C_d A |u_n| u_n on each triangle, with the velocities of the
/// start of the step (forward Euler).
/// @param air  velocity [m/s]; @param dt  [s]
void pushByWind(btSoftBody& body, const btVector3& air, double dt);

/// No naive method, but the wind that plain Bullet is given to bear in place of ours: the same law, each node's drag
/// taken implicitly, so that the air never pushes a node past its own velocity.
/// @param skinFriction  C_f along the surface [-]
void blowSafely(btSoftBody& body, const btVector3& air, double skinFriction, double dt);

}  // namespace stability::naive
