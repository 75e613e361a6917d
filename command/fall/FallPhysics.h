// SPDX-License-Identifier: Zlib
#pragma once

namespace command {

/// Closed forms of a fall from rest. Lengths in m, times in s, SI throughout.

/// In a vacuum: t = sqrt(2 H / g).
double vacuumFallTime(double height, double gravity);

/// Through air that resists in proportion to speed, with time constant tau = m / c: the solution of
/// H = g tau (t - tau (1 - exp(-t / tau))).
double linearDragFallTime(double height, double gravity, double timeConstant);

/// Through air that resists in proportion to speed squared, with terminal speed v: from
/// H = (v^2 / g) ln cosh(g t / v).
double quadraticDragFallTime(double height, double gravity, double terminalSpeed);

/// The distances fallen after a time from rest, of which the three times above are the inverses.
double vacuumFall(double time, double gravity);
double linearDragFall(double time, double gravity, double timeConstant);
double quadraticDragFall(double time, double gravity, double terminalSpeed);

/// Terminal speed of a flat sheet that falls broadside: sqrt(2 sigma g / (rho C_d)).
double terminalSpeed(double arealDensity, double gravity, double airDensity, double dragCoefficient);

}  // namespace command
