// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

class btDeformableBodySolver;
class btDeformableLagrangianForce;
class btMultiBodyConstraintSolver;

namespace command {

/// One of Bullet's three worlds with soft bodies, and all that lives in it: nothing to delete by hand, in no order.
class BulletWorld {
 public:
  struct Settings {
    WorldKind kind = WorldKind::softRigid;
    btVector3 gravity = btVector3(0, btScalar(-9.81), 0);
    int iterations = 10;    ///< of the soft bodies' position solver, and of the contacts' solver
    bool implicit = false;  ///< of the deformable world
    /// None: soft bodies are stepped by Bullet's own solver. Not in the deformable world.
    std::optional<wetcloth::ClothSolver::Parameters> clothSolver;
  };

  explicit BulletWorld(const Settings& settings);
  ~BulletWorld();
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  btDiscreteDynamicsWorld& world() { return *m_world; }
  /// Null: Bullet's own solver.
  wetcloth::ClothSolver* clothSolver() { return m_clothSolver.get(); }
  const wetcloth::ClothSolver* clothSolver() const { return m_clothSolver.get(); }
  btSoftBodyWorldInfo& worldInfo() { return *m_worldInfo; }

  /// The library's world on it, made when it is first asked for: a world that never is runs in Bullet alone.
  wetcloth::WetClothWorld& wet();

  /// Takes the body into the world. In the deformable world it gets gravity, and springs if there are any.
  btSoftBody& add(std::unique_ptr<btSoftBody> body, const DeformableSprings* springs = nullptr);
  /// A body that nothing moves.
  const btCollisionObject& addStatic(std::unique_ptr<btCollisionShape> shape, const btTransform& place);
  /// A body that is moved by setWorldTransform() before each substep. It stays awake.
  btRigidBody& addKinematic(std::unique_ptr<btCollisionShape> shape, const btTransform& place);
  /// A body that moves, or, with a mass of 0 [kg], one that is moved: a kinematic one. It stays awake.
  btRigidBody& addRigid(std::unique_ptr<btCollisionShape> shape, double mass, const btVector3& position);
  void substep(btScalar dt) { m_world->stepSimulation(dt, 0); }

 private:
  void makeSoftRigid();
  void makeSoftMultiBody();
  void makeDeformable();
  btRigidBody& keep(std::unique_ptr<btCollisionShape> shape, std::unique_ptr<btRigidBody> body);
  void addForce(btSoftBody& body, std::unique_ptr<btDeformableLagrangianForce> force);

  Settings m_settings;
  std::unique_ptr<btCollisionConfiguration> m_configuration;
  std::unique_ptr<btCollisionDispatcher> m_dispatcher;
  std::unique_ptr<btBroadphaseInterface> m_broadphase;
  std::unique_ptr<btDeformableBodySolver> m_deformableSolver;
  std::unique_ptr<btConstraintSolver> m_solver;
  std::unique_ptr<wetcloth::ClothSolver> m_clothSolver;
  std::unique_ptr<btDiscreteDynamicsWorld> m_world;
  btSoftBodyWorldInfo* m_worldInfo = nullptr;
  std::function<void(btSoftBody*)> m_addSoftBody;
  std::function<void(btSoftBody*)> m_removeSoftBody;
  std::vector<std::unique_ptr<btDeformableLagrangianForce>> m_forces;
  std::vector<std::unique_ptr<btCollisionShape>> m_shapes;
  std::vector<std::unique_ptr<btRigidBody>> m_rigidBodies;
  std::vector<std::unique_ptr<btSoftBody>> m_softBodies;
  std::unique_ptr<wetcloth::WetClothWorld> m_wet;
};

}  // namespace command
