// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btVector3.h>

#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

// What a fluid does to a triangle that moves through it: shared by Wind and WaterDrag.

/// A triangle's unit normal and area; area 0 and normal 0 for one that has none (or is not finite).
struct FlatTriangle {
  btVector3 normal;
  btScalar area;
};

inline FlatTriangle flatTriangle(const btVector3& a, const btVector3& b, const btVector3& c) {
  const btVector3 twice = (b - a).cross(c - a);
  const btScalar length = twice.length();
  if (!(length > 0 && std::isfinite(length))) return {btVector3(0, 0, 0), 0};
  return {twice / length, length / 2};
}

/// Speed at the end of a step of du/dt = -a |u| u by backward Euler, from speed u: the root of v + a v^2 = u. With it
/// as the lagged coefficient, a falling sheet reaches its terminal speed exactly, whatever the step.
inline btScalar dampedSpeed(btScalar u, btScalar a) { return 2 * u / (1 + std::sqrt(1 + 4 * a * u)); }

/// Force per area and relative speed [N s/m^3], along the normal and along the surface.
struct FluidResistance {
  btScalar linear;     ///< k
  btScalar quadratic;  ///< 1/2 rho C_d
  btScalar friction;   ///< 1/2 rho C_f
  btScalar dt;         ///< of the implicit step, 0: explicit

  /// @param specificArea  of the cloth around the triangle [m^2/kg]
  btScalar normal(btScalar speed, btScalar specificArea) const {
    return linear + quadratic * dampedSpeed(speed, dt * quadratic * specificArea);
  }
  btScalar tangent(btScalar speed, btScalar specificArea) const {
    return friction * dampedSpeed(speed, dt * friction * specificArea);
  }
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
