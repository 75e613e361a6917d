// SPDX-License-Identifier: Zlib
#include "command/scene/BulletWorld.h"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableMassSpringForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

#include <utility>

namespace command {

BulletWorld::BulletWorld(const Settings& settings)
    : m_settings(settings),
      m_configuration(std::make_unique<btSoftBodyRigidBodyCollisionConfiguration>()),
      m_dispatcher(std::make_unique<btCollisionDispatcher>(m_configuration.get())),
      m_broadphase(std::make_unique<btDbvtBroadphase>()) {
  if (settings.clothSolver) m_clothSolver = std::make_unique<wetcloth::ClothSolver>(*settings.clothSolver);
  if (settings.kind == WorldKind::softRigid) makeSoftRigid();
  if (settings.kind == WorldKind::softMultiBody) makeSoftMultiBody();
  if (settings.kind == WorldKind::deformable) makeDeformable();
  // Rigid bodies take their gravity from the world, soft bodies take theirs from the world info.
  m_world->setGravity(settings.gravity);
  m_worldInfo->m_gravity = settings.gravity;
  m_worldInfo->m_sparsesdf.Initialize();
  m_world->getSolverInfo().m_numIterations = settings.iterations;
}

BulletWorld::~BulletWorld() {
  m_wet.reset();  // it detaches while all is there
  for (const auto& body : m_softBodies) m_removeSoftBody(body.get());
  for (const auto& body : m_rigidBodies) m_world->removeRigidBody(body.get());
  m_worldInfo->m_sparsesdf.Reset();
}

void BulletWorld::makeSoftRigid() {
  m_solver = std::make_unique<btSequentialImpulseConstraintSolver>();
  auto world = std::make_unique<btSoftRigidDynamicsWorld>(m_dispatcher.get(), m_broadphase.get(), m_solver.get(),
                                                          m_configuration.get(), m_clothSolver.get());
  m_worldInfo = &world->getWorldInfo();
  m_addSoftBody = [own = world.get()](btSoftBody* body) { own->addSoftBody(body); };
  m_removeSoftBody = [own = world.get()](btSoftBody* body) { own->removeSoftBody(body); };
  m_world = std::move(world);
}

void BulletWorld::makeSoftMultiBody() {
  auto solver = std::make_unique<btMultiBodyConstraintSolver>();
  auto world = std::make_unique<btSoftMultiBodyDynamicsWorld>(m_dispatcher.get(), m_broadphase.get(), solver.get(),
                                                              m_configuration.get(), m_clothSolver.get());
  m_solver = std::move(solver);
  m_worldInfo = &world->getWorldInfo();
  m_addSoftBody = [own = world.get()](btSoftBody* body) { own->addSoftBody(body); };
  m_removeSoftBody = [own = world.get()](btSoftBody* body) { own->removeSoftBody(body); };
  m_world = std::move(world);
}

void BulletWorld::makeDeformable() {
  m_deformableSolver = std::make_unique<btDeformableBodySolver>();
  auto solver = std::make_unique<btDeformableMultiBodyConstraintSolver>();
  solver->setDeformableSolver(m_deformableSolver.get());
  auto world = std::make_unique<btDeformableMultiBodyDynamicsWorld>(
      m_dispatcher.get(), m_broadphase.get(), solver.get(), m_configuration.get(), m_deformableSolver.get());
  m_solver = std::move(solver);
  // In Bullet 3.24 an implicit world without projection does not move at all.
  world->setImplicit(m_settings.implicit);
  world->setUseProjection(m_settings.implicit);
  m_worldInfo = &world->getWorldInfo();
  m_addSoftBody = [own = world.get()](btSoftBody* body) { own->addSoftBody(body); };
  m_removeSoftBody = [own = world.get()](btSoftBody* body) { own->removeSoftBody(body); };
  m_world = std::move(world);
}

wetcloth::WetClothWorld& BulletWorld::wet() {
  if (!m_wet) m_wet = std::make_unique<wetcloth::WetClothWorld>(*m_world);
  return *m_wet;
}

btSoftBody& BulletWorld::add(std::unique_ptr<btSoftBody> body, const DeformableSprings* springs) {
  btSoftBody& added = *body;
  added.m_cfg.piterations = m_settings.iterations;
  added.setActivationState(DISABLE_DEACTIVATION);
  m_addSoftBody(&added);
  m_softBodies.push_back(std::move(body));
  if (m_settings.kind != WorldKind::deformable) return added;
  added.m_cfg.collisions = btSoftBody::fCollision::SDF_RD | btSoftBody::fCollision::SDF_RDF;
  addForce(added, std::make_unique<btDeformableGravityForce>(m_settings.gravity));
  if (springs != nullptr) {
    addForce(added, std::make_unique<btDeformableMassSpringForce>(
                        btScalar(springs->stiffness), btScalar(springs->damping), true, springs->bendingStiffness));
  }
  return added;
}

/// Not through the world: its addForce() gives a second body the parameters of the first force of the same type.
void BulletWorld::addForce(btSoftBody& body, std::unique_ptr<btDeformableLagrangianForce> force) {
  force->addSoftBody(&body);
  force->setIndices(m_deformableSolver->m_objective->getIndices());
  m_deformableSolver->m_objective->m_lf.push_back(force.get());
  m_forces.push_back(std::move(force));
}

const btCollisionObject& BulletWorld::addStatic(std::unique_ptr<btCollisionShape> shape, const btTransform& place) {
  auto body = std::make_unique<btRigidBody>(0, nullptr, shape.get(), btVector3(0, 0, 0));
  body->setWorldTransform(place);
  body->setFriction(1);  // the cloth's own friction decides
  return keep(std::move(shape), std::move(body));
}

btRigidBody& BulletWorld::addKinematic(std::unique_ptr<btCollisionShape> shape, const btTransform& place) {
  btRigidBody& body = addRigid(std::move(shape), 0, place.getOrigin());
  body.setWorldTransform(place);
  body.setInterpolationWorldTransform(place);
  m_world->updateSingleAabb(&body);
  return body;
}

btRigidBody& BulletWorld::addRigid(std::unique_ptr<btCollisionShape> shape, double mass, const btVector3& position) {
  btVector3 inertia(0, 0, 0);
  if (mass > 0) shape->calculateLocalInertia(btScalar(mass), inertia);
  btRigidBody::btRigidBodyConstructionInfo info(btScalar(mass), nullptr, shape.get(), inertia);
  info.m_startWorldTransform.setIdentity();
  info.m_startWorldTransform.setOrigin(position);
  info.m_friction = 1;
  auto body = std::make_unique<btRigidBody>(info);
  if (mass == 0) body->setCollisionFlags(body->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  body->setActivationState(DISABLE_DEACTIVATION);
  return keep(std::move(shape), std::move(body));
}

btRigidBody& BulletWorld::keep(std::unique_ptr<btCollisionShape> shape, std::unique_ptr<btRigidBody> body) {
  m_world->addRigidBody(body.get());
  m_shapes.push_back(std::move(shape));
  m_rigidBodies.push_back(std::move(body));
  return *m_rigidBodies.back();
}

}  // namespace command
