// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/audit/SweptBoxes.h"
#include "bullet_wetcloth/drops/DropPath.h"

#include <LinearMath/btTransform.h>

#include <cstddef>
#include <vector>

class btCollisionObject;
class btCollisionWorld;

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// The bodies of a world that drops may land on: all collision objects that are not soft and that others collide with.
/// A body that moved in the last substep is met as it moved.
class BodyTargets {
 public:
  /// Where a drop meets one.
  struct Hit {
    double time = 2;  ///< in [0, 1] of the way; more than 1: it meets nothing
    const btCollisionObject* body = nullptr;
    Double3 place = {0, 0, 0};   ///< on the body as it is now [m]
    Double3 normal = {0, 0, 0};  ///< out of the body, of length 1
  };

  /// Where each body is now is where it was before, too.
  void restart(const btCollisionWorld& world);
  /// A substep has ended: the bodies went from where they were to where they are now. Allocates when there are more of
  /// them than ever before.
  void advance(const btCollisionWorld& world);

  /// The first body that a drop meets on its way.
  Hit firstHit(const DropPath& path) const;

  void transferState(StateArchive& archive);

 private:
  struct Body {
    const btCollisionObject* object;
    btTransform before;
    btTransform now;
  };

  const Body* find(const btCollisionObject* object, std::size_t guess) const;
  void consider(const DropPath& path, const Body& body, Hit& best) const;

  std::vector<Body> m_bodies;
  std::vector<Body> m_last;  // of the substep before
  SweptBoxes m_boxes;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
