// SPDX-License-Identifier: Zlib
#include "command/fall/FallPhysics.h"

#include <cmath>

namespace command {

double vacuumFallTime(double height, double gravity) { return std::sqrt(2 * height / gravity); }

double linearDragFallTime(double height, double gravity, double timeConstant) {
  // The distance fallen is a convex function of time, so Newton's method comes down to the root from any later time,
  // and steady fall at terminal speed, one time constant late, is later.
  double time = height / (gravity * timeConstant) + timeConstant;
  for (int i = 0; i < 200; ++i) {
    const double lost = -std::expm1(-time / timeConstant);
    const double fallen = gravity * timeConstant * (time - timeConstant * lost);
    const double next = time - (fallen - height) / (gravity * timeConstant * lost);
    if (!(next < time)) break;
    time = next;
  }
  return time;
}

double quadraticDragFallTime(double height, double gravity, double terminalSpeed) {
  // t = (v / g) acosh(exp(x)), x = g H / v^2, written so that exp(x) need not fit a double.
  const double x = gravity * height / (terminalSpeed * terminalSpeed);
  return terminalSpeed / gravity * (x + std::log1p(std::sqrt(-std::expm1(-2 * x))));
}

double vacuumFall(double time, double gravity) { return gravity * time * time / 2; }

double linearDragFall(double time, double gravity, double timeConstant) {
  return gravity * timeConstant * (time + timeConstant * std::expm1(-time / timeConstant));
}

double quadraticDragFall(double time, double gravity, double terminalSpeed) {
  // ln cosh(x), written so that cosh(x) need not fit a double
  const double x = gravity * time / terminalSpeed;
  return terminalSpeed * terminalSpeed / gravity * (x + std::log1p(std::exp(-2 * x)) - std::log(2.0));
}

double terminalSpeed(double arealDensity, double gravity, double airDensity, double dragCoefficient) {
  return std::sqrt(2 * arealDensity * gravity / (airDensity * dragCoefficient));
}

}  // namespace command
