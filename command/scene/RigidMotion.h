// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

#include <vector>

namespace command {

/// Where a rigid body is at which time: straight lines and turns at a steady rate between places that are told; before
/// the first and after the last one it stays.
struct RigidMotion {
  btVector3 pivot = btVector3(0, 0, 0);  ///< point of the body, as it is at rest, that the places are of [m]
  std::vector<double> times;             ///< [s], each later than the one before, at least one
  std::vector<btVector3> places;         ///< of the pivot [m], one for each time
  std::vector<btQuaternion> turns;       ///< from how it is at rest, one for each time

  /// Takes a point of the body at rest to where it is at this time [s].
  btTransform at(double time) const;
  /// No less than the speed of any point that is no farther from the pivot than `reach` [m] at any time [m/s].
  double fastest(double reach) const;
};

/// First `inner`, then `outer`, which moves the whole of it.
RigidMotion chained(const RigidMotion& inner, const RigidMotion& outer);

}  // namespace command
