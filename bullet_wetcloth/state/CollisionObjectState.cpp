// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/state/CollisionObjectState.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

struct ObjectValues {
  btTransform transform;
  btTransform interpolation;
  btVector3 interpolationVelocity;
  btVector3 interpolationSpin;
  int activation;
  btScalar deactivationTime;
  btScalar hitFraction;
};

ObjectValues valuesOf(const btCollisionObject& object) {
  return {object.getWorldTransform(),
          object.getInterpolationWorldTransform(),
          object.getInterpolationLinearVelocity(),
          object.getInterpolationAngularVelocity(),
          object.getActivationState(),
          object.getDeactivationTime(),
          object.getHitFraction()};
}

void set(btCollisionObject& object, const ObjectValues& values) {
  object.setWorldTransform(values.transform);
  object.setInterpolationWorldTransform(values.interpolation);
  object.setInterpolationLinearVelocity(values.interpolationVelocity);
  object.setInterpolationAngularVelocity(values.interpolationSpin);
  object.forceActivationState(values.activation);
  object.setDeactivationTime(values.deactivationTime);
  object.setHitFraction(values.hitFraction);
}

// By component: what Bullet multiplies a force with when it is applied.
btVector3 withoutFactor(const btVector3& applied, const btVector3& factor) {
  btVector3 force(0, 0, 0);
  for (int axis = 0; axis < 3; ++axis) force[axis] = factor[axis] == 0 ? 0 : applied[axis] / factor[axis];
  return force;
}

void transferRigidBody(StateArchive& archive, btRigidBody& body) {
  btVector3 velocity = body.getLinearVelocity();
  btVector3 spin = body.getAngularVelocity();
  btVector3 force = withoutFactor(body.getTotalForce(), body.getLinearFactor());
  btVector3 torque = withoutFactor(body.getTotalTorque(), body.getAngularFactor());
  btVector3 push = body.getPushVelocity();
  btVector3 turn = body.getTurnVelocity();
  archive.value(velocity, spin, force, torque, push, turn);
  if (!archive.isRestoring()) return;
  body.setLinearVelocity(velocity);
  body.setAngularVelocity(spin);
  body.clearForces();
  body.applyCentralForce(force);
  body.applyTorque(torque);
  body.setPushVelocity(push);
  body.setTurnVelocity(turn);
  body.updateInertiaTensor();
}

}  // namespace

void transferCollisionObject(StateArchive& archive, btCollisionObject& object) {
  archive.expect(object.getInternalType(), "a collision object's type");
  ObjectValues values = valuesOf(object);
  archive.value(values.transform, values.interpolation, values.interpolationVelocity, values.interpolationSpin);
  archive.value(values.activation, values.deactivationTime, values.hitFraction);
  if (archive.isRestoring()) set(object, values);
  if (btRigidBody* const rigid = btRigidBody::upcast(&object)) transferRigidBody(archive, *rigid);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
