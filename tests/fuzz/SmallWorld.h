// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "bullet_wetcloth/state/StateEnvelope.h"

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace fuzz {

/// Nine nodes that hang over a plane and a sphere on which a dumbbell lies, with effects of every kind of state, after
/// some steps.
class SmallWorld {
 public:
  SmallWorld() {
    m_world.getWorldInfo().m_sparsesdf.Initialize();
    m_sphere.getWorldTransform().setOrigin(btVector3(btScalar(0.5), btScalar(-0.2), btScalar(0.5)));
    m_world.addRigidBody(&m_sphere);
    for (const double side : {-0.1, 0.1}) {
      m_dumbbellShape.addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(side), 0, 0)), &m_end);
    }
    m_dumbbell.getWorldTransform().setOrigin(btVector3(btScalar(0.5), btScalar(0.14), btScalar(0.5)));
    m_world.addRigidBody(&m_dumbbell);
    m_world.addRigidBody(&m_ground);
    wetcloth::ClothPatch patch;
    patch.columns = patch.rows = 3;
    patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
    m_body = patch.build(m_world.getWorldInfo());
    m_world.addSoftBody(m_body.get());
    m_wet = std::make_unique<wetcloth::WetClothWorld>(m_world);
    wetcloth::WetCloth& cloth = m_wet->add(*m_body);
    cloth.add<wetcloth::Absorption>();
    cloth.add<wetcloth::Diffusion>();
    cloth.add<wetcloth::Dripping>();
    cloth.add<wetcloth::HookeSprings>();
    cloth.add<wetcloth::WetStiffness>();
    cloth.add<wetcloth::Swelling>();
    cloth.add<wetcloth::Cling>();
    cloth.add<wetcloth::Wind>({btVector3(1, 0, 0)});
    cloth.add<wetcloth::CollisionAudit>();
    for (int i = 0; i < 30; ++i) m_world.stepSimulation(btScalar(1) / 240, 0);
    m_start = saved();
  }
  ~SmallWorld() {
    m_wet.reset();
    m_world.removeSoftBody(m_body.get());
    m_world.removeRigidBody(&m_ground);
    m_world.removeRigidBody(&m_dumbbell);
    m_world.removeRigidBody(&m_sphere);
  }
  SmallWorld(const SmallWorld&) = delete;
  SmallWorld& operator=(const SmallWorld&) = delete;

  const std::string& start() const { return m_start; }
  std::string saved() const {
    std::ostringstream stream;
    m_wet->save(stream);
    return stream.str();
  }
  void restore(const std::string& state) {
    std::istringstream stream(state);
    m_wet->restore(stream);
  }
  /// These bytes as a stream that is not refused for its envelope.
  std::string wrapped(const std::string& bytes) const {
    std::ostringstream stream;
    wetcloth::StateEnvelope::write(stream, static_cast<std::uint32_t>(m_world.getWorldType()),
                                   std::vector<unsigned char>(bytes.begin(), bytes.end()));
    return stream.str();
  }

 private:
  btSoftBodyRigidBodyCollisionConfiguration m_configuration;
  btCollisionDispatcher m_dispatcher{&m_configuration};
  btDbvtBroadphase m_broadphase;
  btSequentialImpulseConstraintSolver m_solver;
  btSoftRigidDynamicsWorld m_world{&m_dispatcher, &m_broadphase, &m_solver, &m_configuration};
  btSphereShape m_shape{btScalar(0.3)};
  btRigidBody m_sphere{btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &m_shape)};
  btStaticPlaneShape m_plane{btVector3(0, 1, 0), btScalar(-0.5)};
  btRigidBody m_ground{btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &m_plane)};
  btSphereShape m_end{btScalar(0.05)};
  btCompoundShape m_dumbbellShape;
  btRigidBody m_dumbbell{btRigidBody::btRigidBodyConstructionInfo(
      btScalar(0.1), nullptr, &m_dumbbellShape, btVector3(btScalar(0.001), btScalar(0.001), btScalar(0.001)))};
  std::unique_ptr<btSoftBody> m_body;
  std::unique_ptr<wetcloth::WetClothWorld> m_wet;
  std::string m_start;
};

}  // namespace fuzz
