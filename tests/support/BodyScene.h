// SPDX-License-Identifier: Zlib
#pragma once

#include "tests/support/BulletSprings.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/SoftBodies.h"

#include <memory>

namespace wetcloth_test {

/// A Bullet world with one soft body in it, taken out before both are destroyed.
class BodyScene {
 public:
  BodyScene(WorldKind kind, const BodyBuilder& builder, const btVector3& gravity = kEarthGravity,
            btSoftBodySolver* solver = nullptr)
      : m_bullet(kind, gravity, solver), m_body(builder(m_bullet.info())) {
    m_bullet.add(*m_body);
  }
  explicit BodyScene(WorldKind kind, const wetcloth::ClothPatch& patch = squarePatch(5),
                     const btVector3& gravity = kEarthGravity)
      : BodyScene(
            kind, [&patch](btSoftBodyWorldInfo& info) { return patch.build(info); }, gravity) {}
  ~BodyScene() {
    if (m_body != nullptr) m_bullet.remove(*m_body);
  }
  BodyScene(const BodyScene&) = delete;
  BodyScene& operator=(const BodyScene&) = delete;

  BulletWorld& bullet() { return m_bullet; }
  btDiscreteDynamicsWorld& world() { return m_bullet.world(); }
  btSoftBody& body() { return *m_body; }
  btSoftBody::Node& node(int i) { return m_body->m_nodes[i]; }

  /// Takes the body out of the world and deletes it.
  void deleteBody() {
    m_bullet.remove(*m_body);
    m_body.reset();
  }

  /// Bullet's own springs, which a cloth in the deformable world needs: without them it is a cloud of triangles that
  /// the air crumples. Does nothing in the other worlds, whose links hold a cloth together.
  void addBulletSprings(double stiffness, double damping = 0, SpringDamping acts = SpringDamping::alongSpring) {
    if (m_bullet.isDeformable()) m_bullet.addForce(*m_body, bulletSprings(stiffness, damping, acts));
  }

 private:
  BulletWorld m_bullet;
  std::unique_ptr<btSoftBody> m_body;
};

}  // namespace wetcloth_test
