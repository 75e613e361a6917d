// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/LocalNodes.h"

#include <LinearMath/btVector3.h>

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// Lets pinned nodes, which an application puts elsewhere between two steps, go there in all small steps of the next
/// one, so that what they push has time to give way.
class PinnedWays {
 public:
  /// Puts pinned nodes back to where they were at the end of the last step, with the velocity that brings them to where
  /// they are now in dt [s].
  void spread(LocalNodes& nodes, btScalar dt);
  /// In the last small step: they are exactly where they were put, however the way there was rounded.
  void arrive(LocalNodes& nodes) const;
  /// After the small steps: gives them their own velocities, and remembers where they are.
  void end(LocalNodes& nodes);
  /// As if it had seen no step yet.
  void forget() { m_pins.clear(); }
  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive);

 private:
  struct Pin {
    int node;
    btVector3 place;     // at the end of the last step, in the world [m]
    btVector3 velocity;  // its own, while another one brings it to its place [m/s]
    btVector3 aim;       // where it was put, in the nodes' arrays, and how far its own velocity takes it from there [m]
    bool isMoved;
  };
  std::vector<Pin> m_pins;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
