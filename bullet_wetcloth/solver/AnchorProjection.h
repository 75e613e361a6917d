// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/LocalNodes.h"

#include <BulletSoftBody/btSoftBody.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Anchors of a cloth's nodes in rigid bodies, in small steps: a node goes with its point of the body, and the body
/// feels the pull.
class AnchorProjection {
 public:
  /// The anchors that the body has in this step; wakes what they hold to.
  void prepare(btSoftBody& body, const LocalNodes& nodes);
  /// How many there are.
  std::size_t size() const { return m_anchors.size(); }
  /// Moves the anchored nodes, in a small step of h [s].
  void project(const MovingNodes& nodes, btScalar h);

 private:
  struct Anchor {
    std::size_t slot;
    btRigidBody* rigid;
    btVector3 arm;
    btVector3 place;     // of the body's point at the start of the small step, as the arrays have places
    btMatrix3x3 pushes;  // impulse per change of velocity [kg]
    btScalar inverseMass;
    btScalar influence;
  };

  std::vector<Anchor> m_anchors;
  btScalar m_hardness = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
