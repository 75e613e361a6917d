// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What a rigid body gains in a step by what its corners push; it goes with it in the next one.
///
/// A push is what a body gets that does not give way. This one gains no more along it than what makes it go with the
/// cloth; and what pulls a cloth back that it has stretched in one step does not throw it.
class BodyRecoil {
 public:
  /// Of a body, or null: of what has none, or does not move by impulses.
  BodyRecoil(const btCollisionObject& object, btScalar dt);
  bool isNeeded() const { return m_body != nullptr; }

  /// One small step has so many pushes, which count as simultaneous.
  void beginSmallStep(int pushes);
  /// At a place relative to the centre of mass [m].
  /// @param impulse  that the body gets [kg m/s]
  /// @param met      speed with which both have met there [m/s]
  void add(const btVector3& arm, const btVector3& impulse, btScalar met);
  /// After the step.
  void apply();

 private:
  btRigidBody* m_body;
  btScalar m_radius;    // from the centre of mass to what is farthest [m]
  btScalar m_mostTurn;  // in a step, as an angular velocity [rad/s]
  btScalar m_pushes = 1;
  btVector3 m_velocity = btVector3(0, 0, 0);        // that it gains [m/s]
  btVector3 m_turning = btVector3(0, 0, 0);         // [rad/s]
  btVector3 m_velocityBefore = btVector3(0, 0, 0);  // had gained when the small step began
  btVector3 m_turningBefore = btVector3(0, 0, 0);
  btScalar m_most = 0;  // that it may turn by [rad/s]
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
