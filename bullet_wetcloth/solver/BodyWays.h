// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/BodyPose.h"

#include <BulletSoftBody/btSoftBody.h>

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// The rigid bodies near cloths, and where each of them comes from in this step.
///
/// When Bullet's world steps its soft bodies, the others have moved already. A body comes from where it was at the end
/// of the step before; from where its velocity brought it here, if it was not near then, or was put elsewhere.
class BodyWays {
 public:
  struct Body {
    const btCollisionObject* object;
    int proxy;  ///< in Bullet's broadphase, where a number is another body's only after this one has left
    btTransform from;
    btTransform to;
  };
  /// What is looked for.
  struct Place {
    const btSoftBody* cloth;
    BodyBox box;  ///< in the world
  };

  /// After a step of dt [s]: those that collide with one of the cloths and come to its place.
  void find(const std::vector<Place>& places, btScalar dt);
  const std::vector<Body>& bodies() const { return m_bodies; }
  /// Where they are now they come from in the next step.
  void end() { m_before.swap(m_bodies); }
  void forget() { m_before.clear(); }
  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive);

  /// Whether Bullet lets these two collide.
  static bool collide(const btSoftBody& cloth, const btCollisionObject& object);

 private:
  class Reader;
  btTransform startOf(const btCollisionObject& object, int proxy, btScalar dt) const;
  bool isKnown(int proxy) const;

  std::vector<Body> m_bodies;
  std::vector<Body> m_before;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
