// SPDX-License-Identifier: Zlib
// A small cloth falls flat onto a large one that Bullet is told to collide it with. The audit counts what goes through,
// and a check of one's own finds what Bullet's does not.

#include <bullet_wetcloth/bullet_wetcloth.h>
#include <bullet_wetcloth/collision/ContinuousCheck.h>

#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cstdio>
#include <memory>

namespace ccd = wetcloth::collision;

std::unique_ptr<btSoftBody> sheet(btSoftRigidDynamicsWorld& world, btScalar size, btScalar height, int nodes,
                                  int pins) {
  std::unique_ptr<btSoftBody> body(btSoftBodyHelpers::CreatePatch(
      world.getWorldInfo(), btVector3(-size, height, -size), btVector3(size, height, -size),
      btVector3(-size, height, size), btVector3(size, height, size), nodes, nodes, pins, false));
  body->setTotalMass(btScalar(0.2));
  body->getCollisionShape()->setMargin(btScalar(0.01));  // Bullet's 0.25 keeps cloths a hand apart
  body->m_cfg.collisions |= btSoftBody::fCollision::VF_SS;
  world.addSoftBody(body.get());
  return body;
}

int main() {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.getWorldInfo().m_gravity = world.getGravity();
  world.getWorldInfo().m_sparsesdf.Initialize();
  const auto net = sheet(world, 1, 0, 17, 15);
  const auto scarf = sheet(world, btScalar(0.2), 2, 9, 0);

  wetcloth::WetClothWorld wet(world);
  wetcloth::CollisionAudit::Parameters parameters;
  parameters.self = false;
  auto& audit = wet.add(*scarf).add<wetcloth::CollisionAudit>(parameters);
  for (int i = 0; i < 120; ++i) world.stepSimulation(btScalar(1) / 60, 0);
  audit.look();
  std::printf("passed in 2 s: %lld vertices through faces, %lld edges through edges\n", audit.totals().vertexFace,
              audit.totals().edgeEdge);

  // A point that falls straight down through a triangle, as in the world above
  const ccd::Query<double> query = {{{0, 0.5, 0}, {-1, 0, -1}, {1, 0, -1}, {0, 0, 1}},
                                    {{0, -0.5, 0}, {-1, 0, -1}, {1, 0, -1}, {0, 0, 1}}};
  const ccd::Contact contact = ccd::ContinuousCheck()(ccd::Pair::vertexFace, query);
  std::printf("a point falls through a triangle: %s at %.6f (0.5), weights %.3f %.3f\n",
              contact ? "contact" : "no contact", contact.time, contact.where[0], contact.where[1]);

  world.removeSoftBody(net.get());
  world.removeSoftBody(scarf.get());
  return contact && contact.time <= 0.5 && contact.time > 0.499999 ? 0 : 1;
}
