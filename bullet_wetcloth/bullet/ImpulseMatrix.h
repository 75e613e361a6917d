// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The impulse on a node per change of its velocity relative to a rigid body's, at `arm` from the body's centre: the
/// inverse of 1/m_node + 1/m_body - [r] I^-1 [r] [kg]; zero when neither can move.
inline btMatrix3x3 impulseMatrix(btScalar nodeInverseMass, const btRigidBody& rigid, const btVector3& arm) {
  const btScalar inverseMass = nodeInverseMass + rigid.getInvMass();
  if (inverseMass == 0) return btMatrix3x3(0, 0, 0, 0, 0, 0, 0, 0, 0);
  const btMatrix3x3 cross(0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0);
  const btMatrix3x3 diagonal(inverseMass, 0, 0, 0, inverseMass, 0, 0, 0, inverseMass);
  return (diagonal - cross * rigid.getInvInertiaTensorWorld() * cross).inverse();
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
