// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/state/WorldState.h"

#include "bullet_wetcloth/state/BroadphaseState.h"
#include "bullet_wetcloth/state/CollisionObjectState.h"
#include "bullet_wetcloth/state/DeformableSolverState.h"
#include "bullet_wetcloth/state/RigidContactState.h"

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Protected and without accessors; a pointer to member named through a derived class may reach them.
struct Clock : btDiscreteDynamicsWorld {
  static btScalar& localTime(btDiscreteDynamicsWorld& world) { return world.*(&Clock::m_localTime); }
  static btScalar& fixedStep(btDiscreteDynamicsWorld& world) { return world.*(&Clock::m_fixedTimeStep); }
};

void transferSeed(StateArchive& archive, btDiscreteDynamicsWorld& world) {
  auto* const solver = dynamic_cast<btSequentialImpulseConstraintSolver*>(world.getConstraintSolver());
  archive.expect(solver != nullptr, "whether the constraint solver is a btSequentialImpulseConstraintSolver");
  if (!solver) return;
  std::uint64_t seed = solver->getRandSeed();
  archive.value(seed);
  if (archive.isRestoring()) solver->setRandSeed(static_cast<unsigned long>(seed));
}

}  // namespace

void transferWorld(StateArchive& archive, btDiscreteDynamicsWorld& world, const SoftBodyArray& bodies) {
  archive.expect(world.getNumCollisionObjects(), "the number of collision objects");
  archive.expect(bodies.size(), "the number of soft bodies");
  archive.value(Clock::localTime(world), Clock::fixedStep(world));
  transferSeed(archive, world);
  btCollisionObjectArray& objects = world.getCollisionObjectArray();
  for (int i = 0; i < objects.size(); ++i) transferCollisionObject(archive, *objects[i]);
  const bool isDeformable = world.getWorldType() == BT_DEFORMABLE_MULTIBODY_DYNAMICS_WORLD;
  if (isDeformable) prepareDeformableSolver(archive, bodies);
  for (int i = 0; i < bodies.size(); ++i) transferSoftBody(archive, *bodies[i], bodies);
  if (isDeformable) transferDeformableSolver(archive, bodies);
  transferBroadphase(archive, world);
  transferRigidContacts(archive, world);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
