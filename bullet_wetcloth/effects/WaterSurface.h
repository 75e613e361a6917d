// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

#include <optional>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// The level surface of a body of water: below it is where normal . x + offset < 0.
struct WETCLOTH_EXPORT WaterSurface {
  btVector3 normal = btVector3(0, 1, 0);    ///< out of the water, of any length > 0
  double offset = 0;                        ///< [m] for a normal of length 1; as btSoftBodyWorldInfo::water_offset
  double density = 1000;                    ///< [kg/m^3], > 0
  btVector3 velocity = btVector3(0, 0, 0);  ///< of the water [m/s]

  /// How far a point is below the surface [m], negative above it. The normal must be of length 1.
  double depth(const btVector3& x) const { return -static_cast<double>(normal.dot(x)) - offset; }
  /// Names its fields: see StateArchive.
  void transferState(StateArchive& archive);
};

/// Throws std::invalid_argument naming the field after `prefix` ("Immersion.surface") and the value.
WETCLOTH_EXPORT void requireValid(const char* prefix, const WaterSurface& surface);

/// The surface with a normal of length 1, offset scaled alike.
WETCLOTH_EXPORT WaterSurface normalized(const WaterSurface& surface);

/// `own`, or else the surface that the application has given to Bullet (btSoftBodyWorldInfo::water_normal,
/// water_offset, water_density), with a normal of length 1; none when that has a normal of length 0, which is
/// Bullet's default. A density of 0, Bullet's default too, counts as 1000 kg/m^3.
WETCLOTH_EXPORT std::optional<WaterSurface> surfaceFor(const std::optional<WaterSurface>& own, const btSoftBody& body);

/// The same, and throws std::invalid_argument when there is none: for Effect::attach().
WETCLOTH_EXPORT void requireSurface(const char* prefix, const std::optional<WaterSurface>& own, const btSoftBody& body);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
