// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btVector3.h>

#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The nodes of a body that moves in small steps: one number for each slot.
struct MovingNodes {
  std::size_t count;            ///< a multiple of NodeSlots::kLanes
  btScalar* position[3];        ///< [m]
  btScalar* predicted[3];       ///< where a node would be without links and contacts [m]
  btScalar* velocity[3];        ///< with which it would get there [m/s]
  const btScalar* inverseMass;  ///< [1/kg], 0 of what does not move
  const btScalar* force[3];     ///< on each node, the same in all small steps [N]; null: none

  /// Of the node in a slot [m].
  btVector3 placeOf(std::size_t slot) const {
    return btVector3(position[0][slot], position[1][slot], position[2][slot]);
  }
  /// How far it has moved in a small step of h [s], what displaced it included [m].
  btVector3 wayOf(std::size_t slot, btScalar h) const {
    return btVector3(velocity[0][slot], velocity[1][slot], velocity[2][slot]) * h +
           btVector3(position[0][slot] - predicted[0][slot], position[1][slot] - predicted[1][slot],
                     position[2][slot] - predicted[2][slot]);
  }
};

/// What acts on all nodes in a small step.
///
/// A velocity changes by what links and contacts have displaced its node, over the length of the step. It is not the
/// whole way over that length: in float32 this would round it away.
struct SmallStep {
  btScalar h;         ///< [s], > 0
  btVector3 gravity;  ///< [m/s^2]
  btScalar keeps;     ///< share of the velocity that damping leaves, [0, 1]
  /// Largest change of velocity by a force in a small step, along each axis [m/s], as Bullet limits it.
  btScalar largestPush;

  /// Where the nodes would be after one step of this length; neither places nor velocities change.
  void predict(const MovingNodes& nodes) const;
  /// Moves the nodes in the slots from `first` to `end` to where they would be: in the first small step, or else after
  /// the end() of the one before.
  void advance(const MovingNodes& nodes, bool isFirst, std::size_t first, std::size_t end) const;
  /// After the last one: gives the nodes the velocities that links and contacts have left them.
  void end(const MovingNodes& nodes) const;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
