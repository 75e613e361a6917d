// SPDX-License-Identifier: Zlib
// Lets a soft body fall for a moment: wrong headers, precision or libraries show here.
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <cstdio>

int main() {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, -10, 0));
  world.getWorldInfo().m_gravity = world.getGravity();

  const btVector3 node(0, 0, 0);
  const btScalar mass = 1;
  btSoftBody body(&world.getWorldInfo(), 1, &node, &mass);
  world.addSoftBody(&body);
  for (int step = 0; step < 100; ++step) {
    world.stepSimulation(btScalar(0.01), 0);
  }
  const double height = body.m_nodes[0].m_x.y();
  world.removeSoftBody(&body);

  std::printf("fell to %g m\n", height);
  return std::abs(height + 5) < 0.1 ? 0 : 1;
}
