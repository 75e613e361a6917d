// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What a drop of water flies through, and what it is made of. The defaults are those of 20 degrees Celsius at sea
/// level.
struct DropAir {
  double density = 1.204;          ///< of the air [kg/m^3], >= 0; 0 is a vacuum
  double viscosity = 1.82e-5;      ///< of the air, dynamic [Pa s], >= 0
  double waterDensity = 998;       ///< [kg/m^3], > 0
  double surfaceTension = 0.0728;  ///< of the water [N/m], > 0
};

/// Diameter of a sphere of water [m]: (6 m / (pi rho))^(1/3).
/// @param mass  [kg]; @param waterDensity  [kg/m^3]
WETCLOTH_EXPORT double dropDiameter(double mass, double waterDensity);

/// Mass of a sphere of water [kg]: rho pi d^3 / 6.
/// @param diameter  [m]; @param waterDensity  [kg/m^3]
WETCLOTH_EXPORT double dropMass(double diameter, double waterDensity);

/// The rate k at which air takes a drop's velocity u relative to it away [1/s], du/dt = -k u:
/// k = 18 mu / (rho_w d^2) (1 + 0.15 Re^0.687) (1 + 2.632 y), Re = rho d |u| / mu, y = We / 12.
///
/// The first factor is Stokes' law, the second the drag on a sphere by Schiller & Naumann (1933), from Re = 1000 on
/// that of a drag coefficient of 0.44. The third is that of a drop that the air has flattened (Liu, Mather & Reitz
/// 1993): y is its steady distortion by We = rho u^2 (d/2) / sigma, at most 1. Within 9 % of the terminal velocities
/// that Gunn & Kinzer (1949) measured, from 0.1 mm to 5.8 mm.
/// @param diameter  d [m], > 0; @param speed  |u| [m/s], >= 0
WETCLOTH_EXPORT double dropDecay(double diameter, double speed, const DropAir& air);

/// The speed at which a drop falls through still air in the end [m/s]: k u = g.
/// @param diameter  [m], > 0; @param gravity  g [m/s^2], >= 0
WETCLOTH_EXPORT double terminalSpeed(double diameter, double gravity, const DropAir& air);

/// How far a drop comes in dt, along one axis, by du/dt = g - k u with k held: exact then, and stable for any step.
struct DropMove {
  /// @param decay  k [1/s], >= 0; @param dt  [s], >= 0
  WETCLOTH_EXPORT DropMove(double decay, double dt);

  double keeps;     ///< share of the relative velocity that is left: exp(-k dt)
  double gains;     ///< velocity for each m/s^2 [s]: (1 - exp(-k dt)) / k
  double advances;  ///< way for each m/s of relative velocity [s]: the same
  double falls;     ///< way for each m/s^2 [s^2]: (dt - gains) / k
  double carries;   ///< way for each m/s of wind [s]: dt

  /// Velocity after the step [m/s]. @param velocity  before; @param wind  [m/s]; @param gravity  [m/s^2]
  double velocity(double velocity, double wind, double gravity) const {
    return wind + (velocity - wind) * keeps + gravity * gains;
  }
  /// Way in the step [m].
  double way(double velocity, double wind, double gravity) const {
    return wind * carries + (velocity - wind) * advances + gravity * falls;
  }
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
