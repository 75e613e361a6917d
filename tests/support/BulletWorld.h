// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <memory>
#include <ostream>
#include <vector>

namespace wetcloth_test {

/// Bullet's three worlds with soft bodies; the deformable one integrates in two ways.
enum class WorldKind { softRigid, softMultiBody, deformable, deformableImplicit };

inline const char* nameOf(WorldKind kind) {
  switch (kind) {
    case WorldKind::softRigid: return "softRigid";
    case WorldKind::softMultiBody: return "softMultiBody";
    case WorldKind::deformable: return "deformable";
    case WorldKind::deformableImplicit: break;
  }
  return "deformableImplicit";
}

inline std::ostream& operator<<(std::ostream& out, WorldKind kind) { return out << nameOf(kind); }

inline const btVector3 kEarthGravity(0, btScalar(-9.81), 0);
inline const btVector3 kNoGravity(0, 0, 0);

/// Room for the contacts of a test. Bullet's usual pools are eight megabytes, which cost more to fill with zeros than
/// most tests take; what does not fit comes from the heap.
inline btDefaultCollisionConstructionInfo smallPools() {
  btDefaultCollisionConstructionInfo info;
  info.m_defaultMaxPersistentManifoldPoolSize = 64;
  info.m_defaultMaxCollisionAlgorithmPoolSize = 64;
  return info;
}

/// A Bullet world with everything that it needs, as an application would set it up; nothing of ours in it. Bodies
/// that are added stay the caller's, who may destroy them before or after the world.
class BulletWorld {
 public:
  /// A solver of soft bodies other than Bullet's own is for the two position-based worlds, and outlives this.
  explicit BulletWorld(WorldKind kind, const btVector3& gravity = kEarthGravity, btSoftBodySolver* solver = nullptr)
      : m_kind(kind) {
    if (kind == WorldKind::softRigid) {
      m_world =
          std::make_unique<btSoftRigidDynamicsWorld>(&m_dispatcher, &m_broadphase, &m_solver, &m_configuration, solver);
    } else if (kind == WorldKind::softMultiBody) {
      m_world = std::make_unique<btSoftMultiBodyDynamicsWorld>(&m_dispatcher, &m_broadphase, &m_multiBodySolver,
                                                               &m_configuration, solver);
    } else {
      m_deformableConstraintSolver.setDeformableSolver(&m_deformableSolver);
      m_world = std::make_unique<btDeformableMultiBodyDynamicsWorld>(
          &m_dispatcher, &m_broadphase, &m_deformableConstraintSolver, &m_configuration, &m_deformableSolver);
      if (kind == WorldKind::deformableImplicit) {
        deformable().setImplicit(true);
        deformable().setUseProjection(true);  // without it nothing moves in Bullet 3.24
      }
    }
    m_world->setGravity(gravity);
    info().m_gravity = gravity;
    info().m_sparsesdf.Initialize();
  }
  // Bullet's own destructor looks at every body that is still in the world, and a test's bodies may be gone by then.
  ~BulletWorld() {
    if (m_world) m_world->getCollisionObjectArray().clear();
  }
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  WorldKind kind() const { return m_kind; }
  bool isDeformable() const { return m_kind == WorldKind::deformable || m_kind == WorldKind::deformableImplicit; }
  btDiscreteDynamicsWorld& world() { return *m_world; }
  btDeformableMultiBodyDynamicsWorld& deformable() {
    return static_cast<btDeformableMultiBodyDynamicsWorld&>(*m_world);
  }
  btSoftBodyWorldInfo& info() {
    if (isDeformable()) return deformable().getWorldInfo();
    if (m_kind == WorldKind::softRigid) return static_cast<btSoftRigidDynamicsWorld&>(*m_world).getWorldInfo();
    return static_cast<btSoftMultiBodyDynamicsWorld&>(*m_world).getWorldInfo();
  }

  /// Adds a soft body; in the deformable world with gravity, as that world wants it.
  void add(btSoftBody& body, int group = btBroadphaseProxy::DefaultFilter, int mask = btBroadphaseProxy::AllFilter) {
    if (m_kind == WorldKind::softRigid) {
      static_cast<btSoftRigidDynamicsWorld&>(*m_world).addSoftBody(&body, group, mask);
    } else if (m_kind == WorldKind::softMultiBody) {
      static_cast<btSoftMultiBodyDynamicsWorld&>(*m_world).addSoftBody(&body, group, mask);
    } else {
      deformable().addSoftBody(&body, group, mask);
      addForce(body, std::make_unique<btDeformableGravityForce>(info().m_gravity));
    }
  }
  /// A force of the deformable world, for example btDeformableMassSpringForce; kept for the world's life.
  void addForce(btSoftBody& body, std::unique_ptr<btDeformableLagrangianForce> force) {
    deformable().addForce(&body, force.get());
    m_forces.push_back(std::move(force));
  }
  void remove(btSoftBody& body) { m_world->removeCollisionObject(&body); }
  /// Deletes the world with the bodies in it, which must be there; nothing else is to be called afterwards.
  void deleteWorld() { m_world.reset(); }

  /// `count` substeps of exactly dt.
  void step(int count, btScalar dt = btScalar(1) / 240) {
    for (int i = 0; i < count; ++i) m_world->stepSimulation(dt, 0);
  }

 private:
  WorldKind m_kind;
  btSoftBodyRigidBodyCollisionConfiguration m_configuration{smallPools()};
  btCollisionDispatcher m_dispatcher{&m_configuration};
  btDbvtBroadphase m_broadphase;
  btSequentialImpulseConstraintSolver m_solver;
  btMultiBodyConstraintSolver m_multiBodySolver;
  btDeformableBodySolver m_deformableSolver;
  btDeformableMultiBodyConstraintSolver m_deformableConstraintSolver;
  std::vector<std::unique_ptr<btDeformableLagrangianForce>> m_forces;
  std::unique_ptr<btDiscreteDynamicsWorld> m_world;
};

/// True with Bullet's float64 build.
inline constexpr bool kIsDouble = sizeof(btScalar) == sizeof(double);

}  // namespace wetcloth_test
