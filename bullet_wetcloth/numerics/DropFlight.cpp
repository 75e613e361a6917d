// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/DropFlight.h"

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kSphere = 3.14159265358979323846 / 6;  // volume of a sphere over that of the cube round it

}  // namespace

double dropDiameter(double mass, double waterDensity) { return std::cbrt(mass / (kSphere * waterDensity)); }

double dropMass(double diameter, double waterDensity) {
  return waterDensity * kSphere * diameter * diameter * diameter;
}

double dropDecay(double diameter, double speed, const DropAir& air) {
  constexpr double turbulent = 1000;  // Reynolds number from which on the drag coefficient stays 0.44
  const double inertia = air.density * diameter * speed;
  const double stokes = 18 / (air.waterDensity * diameter * diameter);
  const bool isTurbulent = inertia >= turbulent * air.viscosity;
  const double resistance =
      isTurbulent ? 0.44 / 24 * inertia : air.viscosity * (1 + 0.15 * std::pow(inertia / air.viscosity, 0.687));
  const double weber = inertia * speed / (2 * air.surfaceTension);
  const double distortion = std::min(weber / 12, 1.0);
  return stokes * resistance * (1 + 2.632 * distortion);
}

double terminalSpeed(double diameter, double gravity, const DropAir& air) {
  double low = 0;
  double high = 1;
  while (high < 1e9 && dropDecay(diameter, high, air) * high < gravity) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (dropDecay(diameter, middle, air) * middle < gravity ? low : high) = middle;
  }
  return (low + high) / 2;
}

DropMove::DropMove(double decay, double dt) : carries(dt) {
  const double z = decay * dt;
  keeps = std::exp(-z);
  // The differences lose their digits where little is taken away; there the series has them.
  const bool isSmall = z < 1e-3;
  const double mean = isSmall ? 1 - z / 2 + z * z / 6 - z * z * z / 24 : (1 - keeps) / z;
  gains = advances = dt * mean;
  falls = dt * dt * (isSmall ? 0.5 - z / 6 + z * z / 24 - z * z * z / 120 : (1 - mean) / z);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
