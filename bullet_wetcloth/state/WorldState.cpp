// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/state/WorldState.h"

#include "bullet_wetcloth/state/BroadphaseState.h"
#include "bullet_wetcloth/state/BulletClass.h"
#include "bullet_wetcloth/state/CollisionObjectState.h"
#include "bullet_wetcloth/state/DeformableSolverState.h"
#include "bullet_wetcloth/state/DistanceCacheState.h"
#include "bullet_wetcloth/state/RigidContactState.h"
#include "bullet_wetcloth/state/TriangleCacheState.h"

#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Protected and without accessors; a pointer to member named through a derived class may reach them.
struct Clock : btDiscreteDynamicsWorld {
  static btScalar& localTime(btDiscreteDynamicsWorld& world) { return world.*(&Clock::m_localTime); }
  static btScalar& fixedStep(btDiscreteDynamicsWorld& world) { return world.*(&Clock::m_fixedTimeStep); }
};

void transferSeed(StateArchive& archive, btDiscreteDynamicsWorld& world) {
  btSequentialImpulseConstraintSolver* const solver = asSequentialImpulse(world.getConstraintSolver());
  if (!solver) {
    archive.fail(
        "the world's constraint solver is not Bullet's btSequentialImpulseConstraintSolver or the one of its "
        "kind for multibodies, deformable bodies or conjugate gradients; the state of others is not saved");
  }
  std::uint64_t seed = solver->getRandSeed();
  archive.value(seed);
  if (archive.isRestoring()) solver->setRandSeed(static_cast<unsigned long>(seed));
}

// Bullet turns off a constraint that breaks.
void transferConstraints(StateArchive& archive, btDiscreteDynamicsWorld& world) {
  archive.expect(world.getNumConstraints(), "the number of constraints");
  for (int i = 0; i < world.getNumConstraints(); ++i) {
    btTypedConstraint& constraint = *world.getConstraint(i);
    archive.expect(constraint.getConstraintType(), "a constraint's type");
    bool isEnabled = constraint.isEnabled();
    archive.value(isEnabled);
    if (archive.isRestoring()) constraint.setEnabled(isEnabled);
  }
}

void requireNoMultiBodies(StateArchive& archive, const btDiscreteDynamicsWorld& world) {
  if (world.getWorldType() == BT_SOFT_RIGID_DYNAMICS_WORLD) return;
  // Bullet's other two worlds of soft bodies.
  const int number = static_cast<const btMultiBodyDynamicsWorld&>(world).getNumMultibodies();
  if (number > 0) archive.fail("the world has multibodies (" + std::to_string(number) + "), whose state is not saved");
}

bool mayTouch(const btSoftBody& a, const btSoftBody& b) {
  using Collisions = btSoftBody::fCollision;
  const btBroadphaseProxy& first = *a.getBroadphaseHandle();
  const btBroadphaseProxy& second = *b.getBroadphaseHandle();
  return (a.m_cfg.collisions & b.m_cfg.collisions & Collisions::SVSmask) == Collisions::VF_DD &&
         (first.m_collisionFilterGroup & second.m_collisionFilterMask) != 0 &&
         (second.m_collisionFilterGroup & first.m_collisionFilterMask) != 0;
}

// The deformable world goes through these contacts by random numbers whose seed nothing outside reaches.
void requireNoSoftContacts(StateArchive& archive, const SoftBodyArray& bodies) {
  for (int i = 0; i < bodies.size(); ++i) {
    for (int k = 0; k <= i; ++k) {
      if (!mayTouch(*bodies[i], *bodies[k]) || (i == k && !bodies[i]->useSelfCollision())) continue;
      archive.fail("soft body " + std::to_string(i) + " may touch " +
                   (i == k ? "itself (setSelfCollision())" : "soft body " + std::to_string(k)) +
                   " (VF_DD, filter groups and masks); Bullet's deformable world shuffles such contacts by random "
                   "numbers that are not saved");
    }
  }
}

}  // namespace

void transferWorld(StateArchive& archive, btDiscreteDynamicsWorld& world, const SoftBodyArray& bodies) {
  archive.expect(world.getNumCollisionObjects(), "the number of collision objects");
  archive.expect(bodies.size(), "the number of soft bodies");
  archive.value(Clock::localTime(world), Clock::fixedStep(world));
  requireNoMultiBodies(archive, world);
  transferSeed(archive, world);
  transferConstraints(archive, world);
  btCollisionObjectArray& objects = world.getCollisionObjectArray();
  for (int i = 0; i < objects.size(); ++i) transferCollisionObject(archive, *objects[i]);
  const bool isDeformable = world.getWorldType() == BT_DEFORMABLE_MULTIBODY_DYNAMICS_WORLD;
  if (isDeformable) requireNoSoftContacts(archive, bodies);
  if (isDeformable) prepareDeformableSolver(archive, bodies);
  for (int i = 0; i < bodies.size(); ++i) transferSoftBody(archive, *bodies[i], bodies);
  if (isDeformable) transferDeformableSolver(archive, bodies);
  transferBroadphase(archive, world);
  transferTriangleCaches(archive, world);
  transferDistanceCaches(archive, world, bodies);
  transferRigidContacts(archive, world);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
