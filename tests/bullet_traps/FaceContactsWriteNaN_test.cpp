// SPDX-License-Identifier: Zlib
// In the deformable world a body that collides by faces (SDF_RDF) and has a face without area gets positions that are
// not finite at its first contact, in plain Bullet up to 3.24; one that collides by nodes (SDF_RDN) does not.
// docs/meshes.md.

#include "tests/support/BulletWorld.h"
#include "tests/support/RigidBody.h"

#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <gtest/gtest.h>

#include <cmath>

namespace wetcloth_test::face_contacts_write_nan_test {
namespace {

bool staysFinite(int contacts) {
  BulletWorld world(WorldKind::deformable);
  btScalar vertices[] = {0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, btScalar(0.5), 0, 0};
  int corners[] = {0, 1, 2, 0, 2, 3, 0, 4, 1};  // the last is a line
  const std::unique_ptr<btSoftBody> body(btSoftBodyHelpers::CreateFromTriMesh(world.info(), vertices, corners, 3));
  body->setTotalMass(btScalar(0.1));
  body->m_cfg.collisions = btSoftBody::fCollision::SDF_RD | contacts;
  body->getCollisionShape()->setMargin(btScalar(0.02));
  RigidBody floor(world, box(10, 0.5, 10), 0, btVector3(0, btScalar(-0.518), 0));
  world.add(*body);
  world.step(24);
  bool isFinite = true;
  for (int i = 0; i < body->m_nodes.size(); ++i) isFinite = isFinite && std::isfinite(body->m_nodes[i].m_x.length2());
  world.remove(*body);
  return isFinite;
}

TEST(FaceContactsWriteNaN, OfAFaceWithoutArea) {
  EXPECT_EQ(staysFinite(btSoftBody::fCollision::SDF_RDF), btGetVersion() >= 325);
  EXPECT_TRUE(staysFinite(btSoftBody::fCollision::SDF_RDN));
}

}  // namespace
}  // namespace wetcloth_test::face_contacts_write_nan_test
