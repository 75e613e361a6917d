// SPDX-License-Identifier: Zlib
#pragma once

namespace reality {

/// A level sheet that falls through still air from rest, broadside on.
struct FallingSheet {
  double area;             ///< [m^2]
  double arealDensity;     ///< [kg/m^2]
  double dragCoefficient;  ///< [-]
};

/// Speed at which it goes on [m/s], by Wind in Bullet's world.
double terminalSpeedOf(const FallingSheet& sheet);
/// Time in which it falls that far [s].
double fallTimeOf(const FallingSheet& sheet, double height);

}  // namespace reality
