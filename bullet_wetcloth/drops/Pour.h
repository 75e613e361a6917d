// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btTransform.h>
#include <LinearMath/btVector3.h>

#include <functional>
#include <limits>
#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Water that comes out of a spout, drop by drop. The spout may move.
struct Pour {
  btVector3 position = btVector3(0, 0, 0);   ///< of the middle of the spout's mouth [m]
  btVector3 velocity = btVector3(0, -1, 0);  ///< of the water that leaves it [m/s]
  double flow = 0.05;                        ///< [kg/s], >= 0
  double dropDiameter = 4e-3;                ///< [m], (0, 0.1]
  double mouthRadius = 0;                    ///< drops begin anywhere in a disc across the velocity [m], >= 0
  double halfAngle = 0;                      ///< by which drops go astray, as from a shower head [rad], [0, pi/2)
  double start = 0;                          ///< simulated time at which it begins to flow [s]
  double stop = std::numeric_limits<double>::infinity();  ///< and ends [s], >= start
  /// Asked before each substep, and only while it flows: changes what changes in time of the fields above. What is out
  /// of range then counts as no flow; what it throws ends the pour, with a message.
  std::function<void(Pour& pour, double time)> move = {};
};

/// Throws std::invalid_argument naming the field after `prefix` ("pours[0]") and the value.
WETCLOTH_EXPORT void requireValid(const std::string& prefix, const Pour& pour);

/// A glass, a cylinder that is open at the top, from which water runs over the lowest point of the rim when it is
/// tilted: what is above heldInTiltedGlass() leaves within some `timeConstant`s, by the speed sqrt(2 g h) of the head h
/// that it has over the rim (Torricelli).
struct Glass {
  double radius = 0.035;       ///< of the water in it [m], > 0
  double height = 0.1;         ///< from the bottom to the rim [m], > 0
  double water = 0.25;         ///< in it at the beginning [kg], >= 0: no more than it holds when it stands upright
  double dropDiameter = 5e-3;  ///< [m], (0, 0.1]
  double timeConstant = 0.05;  ///< in which what is too much leaves [s], > 0; a guess
  /// Where it is: its bottom's middle at the origin, its axis along y. Asked for the time of each substep [s]; without
  /// it the glass stands at the origin. A pose that is not finite counts as the last one that was.
  std::function<btTransform(double time)> pose = {};
};

/// Throws std::invalid_argument naming the field after `prefix` ("glasses[0]") and the value.
WETCLOTH_EXPORT void requireValid(const std::string& prefix, const Glass& glass);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
