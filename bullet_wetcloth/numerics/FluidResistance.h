// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btVector3.h>

#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

// The force of a fluid on a triangle that moves through it, for air (Wind) and water (WaterDrag).

/// A triangle's unit normal and its area [m^2]. Both are 0 for a triangle without area, or whose corners are not
/// finite.
struct FlatTriangle {
  btVector3 normal;  ///< of length 1
  btScalar area;     ///< [m^2]
};

inline FlatTriangle flatTriangle(const btVector3& a, const btVector3& b, const btVector3& c) {
  const btVector3 twice = (b - a).cross(c - a);
  const btScalar length = twice.length();
  if (!(length > 0 && std::isfinite(length))) return {btVector3(0, 0, 0), 0};
  return {twice / length, length / 2};
}

/// The speed v after a step in which quadratic drag slows down a speed u >= 0 [m/s]: backward Euler for
/// du/dt = -c u^2, so v + a v^2 = u with a = c dt [s/m], >= 0.
///
/// An implicit step that is linear in the velocity takes v for the speed in its drag coefficient. So a falling sheet
/// reaches its exact terminal speed, however long the step.
inline btScalar dampedSpeed(btScalar u, btScalar a) { return 2 * u / (1 + std::sqrt(1 + 4 * a * u)); }

/// How strongly a fluid resists: force per area and per relative speed [N s/m^3], along the normal of a triangle and
/// along its surface.
struct FluidResistance {
  btScalar linear;     ///< of the linear law, k [N s/m^3]
  btScalar quadratic;  ///< of the quadratic law along the normal, 1/2 rho C_d [kg/m^3]
  btScalar friction;   ///< of the quadratic law along the surface, 1/2 rho C_f [kg/m^3]
  btScalar dt;         ///< step of the implicit integration [s]; 0: explicit

  /// @param speed         relative to the fluid in this direction [m/s], >= 0
  /// @param specificArea  area per mass of the cloth around the triangle [m^2/kg]
  btScalar normal(btScalar speed, btScalar specificArea) const {
    return linear + quadratic * dampedSpeed(speed, dt * quadratic * specificArea);
  }
  /// The same along the surface.
  btScalar tangent(btScalar speed, btScalar specificArea) const {
    return friction * dampedSpeed(speed, dt * friction * specificArea);
  }
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
