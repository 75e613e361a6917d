// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/BodyRecoil.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <algorithm>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// With which what a body has stretched pushes it out, at most [m/s].
constexpr btScalar kPushedOut = btScalar(0.5);
// And it does not begin to turn faster than corners that go straight can show, in a step [rad].
constexpr btScalar kMostTurn = btScalar(0.1);

btScalar radiusOf(const btCollisionShape& shape) {
  btVector3 centre;
  btScalar radius = 0;
  shape.getBoundingSphere(centre, radius);
  return centre.length() + radius;
}

}  // namespace

BodyRecoil::BodyRecoil(const btCollisionObject& object, btScalar dt)
    : m_body(const_cast<btRigidBody*>(btRigidBody::upcast(&object))),
      m_radius(radiusOf(*object.getCollisionShape())),
      m_mostTurn(kMostTurn / dt) {
  if (m_body && (m_body->isStaticOrKinematicObject() || !(m_body->getInvMass() > 0))) m_body = nullptr;
}

void BodyRecoil::beginSmallStep(int pushes) {
  m_pushes = static_cast<btScalar>(pushes);
  m_velocityBefore = m_velocity;
  m_turningBefore = m_turning;
}

void BodyRecoil::add(const btVector3& arm, const btVector3& impulse, btScalar met) {
  const btScalar size = impulse.length();
  const btVector3 along = impulse / size;
  const btVector3 turn = m_body->getInvInertiaTensorWorld() * arm.cross(along);
  const btScalar yield = m_body->getInvMass() + turn.dot(arm.cross(along));
  const auto speedOf = [&](const btVector3& velocity, const btVector3& turning) {
    return (velocity + turning.cross(arm)).dot(along);
  };
  const btScalar gain = speedOf(m_velocityBefore, m_turningBefore);
  const btScalar own = speedOf(m_body->getLinearVelocity(), m_body->getAngularVelocity());
  const btScalar stopped = std::min(met, -own) - gain;
  const btScalar pushedOut = std::min(met, kPushedOut - own) - gain;
  const auto impulseFor = [&](btScalar change) {
    return std::max(std::min(size, change / (yield * m_pushes)), btScalar(0));
  };
  m_velocity += along * (impulseFor(pushedOut) * m_body->getInvMass());
  m_turning += turn * impulseFor(stopped);
  m_most = std::max(m_most, std::min(stopped / m_radius, m_mostTurn));
}

void BodyRecoil::apply() {
  if (m_velocity.isZero() && m_turning.isZero()) return;
  const btScalar turning = m_turning.length();
  if (turning > m_most) m_turning *= m_most / turning;
  m_body->setLinearVelocity(m_body->getLinearVelocity() + m_velocity * m_body->getLinearFactor());
  m_body->setAngularVelocity(m_body->getAngularVelocity() + m_turning * m_body->getAngularFactor());
  m_body->activate();
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
