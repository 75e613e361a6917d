// SPDX-License-Identifier: Zlib
#pragma once

#include "tests/support/BulletWorld.h"

#include <memory>
#include <utility>

namespace wetcloth_test {

/// A rigid body in a world, taken out before it is destroyed.
class RigidBody {
 public:
  RigidBody(BulletWorld& bullet, std::unique_ptr<btCollisionShape> shape, btScalar mass, const btVector3& position)
      : m_bullet(bullet), m_shape(std::move(shape)) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) m_shape->calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, m_shape.get(), inertia);
    info.m_startWorldTransform.setIdentity();
    info.m_startWorldTransform.setOrigin(position);
    m_body = std::make_unique<btRigidBody>(info);
    m_bullet.world().addRigidBody(m_body.get());
  }
  ~RigidBody() { m_bullet.world().removeRigidBody(m_body.get()); }
  RigidBody(const RigidBody&) = delete;
  RigidBody& operator=(const RigidBody&) = delete;

  btRigidBody& body() { return *m_body; }

 private:
  BulletWorld& m_bullet;
  std::unique_ptr<btCollisionShape> m_shape;
  std::unique_ptr<btRigidBody> m_body;
};

inline std::unique_ptr<btCollisionShape> box(double halfX, double halfY, double halfZ) {
  auto shape = std::make_unique<btBoxShape>(btVector3(btScalar(halfX), btScalar(halfY), btScalar(halfZ)));
  return shape;
}

}  // namespace wetcloth_test
