// SPDX-License-Identifier: Zlib
#include "command/stability/CaseScene.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

namespace stability {
namespace {

using command::WorldKind;

WorldKind kindOf(World world) {
  if (isDeformable(world)) return WorldKind::deformable;
  return world == World::softMultiBody ? WorldKind::softMultiBody : WorldKind::softRigid;
}

/// Ours has the guard in its world; what one would write first goes without it there.
std::optional<wetcloth::ClothSolver::Parameters> solverOf(World world, Way way) {
  const bool isOurs = way == Way::ours;
  const bool isWithout = way == Way::naive && world == World::softRigidGuard;
  const bool isOnClothSolver = world == World::softRigidClothSolver || world == World::softRigidGuard;
  if (isWithout || (isOurs && isOnClothSolver)) return wetcloth::ClothSolver::Parameters();
  return std::nullopt;
}

constexpr double kBendingShare = 0.01;  // of the stiffness of a link that bends
constexpr double kFloorHalfExtent = 50;

void makeHeavy(btSoftBody& body) {
  const btScalar factor = btScalar(1 / (1 + wetcloth::Fabric::cotton().capacity));
  for (int i = 0; i < body.m_nodes.size(); ++i) body.m_nodes[i].m_im *= factor;
  body.updateLinkConstants();
}

}  // namespace

CaseScene::CaseScene(World world, Way way, double dt, const btVector3& gravity)
    : m_world(world), m_way(way), m_dt(dt), m_gravity(double(gravity.length())) {
  command::BulletWorld::Settings settings;
  settings.kind = kindOf(world);
  settings.gravity = gravity;
  settings.implicit = world == World::deformableImplicit;
  settings.clothSolver = solverOf(world, way);
  m_bullet = std::make_unique<command::BulletWorld>(settings);
  if (m_bullet->clothSolver() != nullptr) m_bullet->clothSolver()->setLog({});
  if (!isOurs()) return;
  m_wetWorld = &m_bullet->wet();
  m_wetWorld->setLog({});
}

btSoftBody& CaseScene::add(std::unique_ptr<btSoftBody> body, double stiffness) {
  command::DeformableSprings springs;
  springs.stiffness = stiffness;
  springs.bendingStiffness = kBendingShare * stiffness;
  btSoftBody& added = m_bullet->add(std::move(body), isOurs() ? nullptr : &springs);
  // Bullet's deformable world builds a tree of the faces for its collisions, and never returns from that where they are
  // not all connected by edges.
  added.m_cfg.collisions = 0;
  m_cloths.push_back({&added, stiffness});
  return added;
}

void CaseScene::collide(btSoftBody& body, bool withCloths) {
  using Flags = btSoftBody::fCollision;
  body.getCollisionShape()->setMargin(btScalar(0.02));
  body.m_cfg.kDF = btScalar(0.5);
  body.m_cfg.collisions = isDeformable(m_world) ? Flags::SDF_RD | Flags::SDF_RDN | (withCloths ? Flags::VF_DD : 0)
                                                : Flags::SDF_RS | (withCloths ? Flags::VF_SS : 0);
}

CaseScene::Cloth& CaseScene::clothOf(const btSoftBody& body) {
  for (Cloth& cloth : m_cloths) {
    if (cloth.body == &body) return cloth;
  }
  throw std::logic_error("a body of another scene");
}

wetcloth::WetCloth* CaseScene::wet(btSoftBody& body, const wetcloth::Fabric& fabric) {
  if (!isOurs()) return nullptr;
  Cloth& cloth = clothOf(body);
  cloth.wet = &m_wetWorld->add(body, fabric);
  if (isDeformable(m_world)) {
    wetcloth::HookeSprings::Parameters springs;
    springs.stiffness = cloth.stiffness;
    springs.bendingStiffness = kBendingShare * cloth.stiffness;
    springs.iterations = springIterations;
    cloth.wet->add<wetcloth::HookeSprings>(springs);
  }
  return cloth.wet;
}

wetcloth::CollisionAudit* CaseScene::audit(btSoftBody& body) {
  if (isPlainBullet()) return nullptr;
  m_bullet->wet().setLog({});
  wetcloth::CollisionAudit::Parameters parameters;
  // Edges side by side in flat cloth that stretches may pass for crossing by any other.
  if (wetcloth::collision::ContinuousCheck::hasExact()) parameters.tier = wetcloth::collision::Tier::exact;
  return &m_bullet->wet().add(body, wetcloth::Fabric::cotton()).add<wetcloth::CollisionAudit>(parameters);
}

void CaseScene::guardBy(const wetcloth::ClothSolver::Guard& guard) {
  if (!isOurs() || m_world != World::softRigidGuard) return;
  wetcloth::ClothSolver::Parameters parameters = m_bullet->clothSolver()->parameters();
  parameters.guard = guard;
  m_bullet->clothSolver()->setParameters(parameters);
}

btRigidBody& CaseScene::addFloor(double height) {
  const btScalar half = btScalar(kFloorHalfExtent);
  return addRigid(std::make_unique<btBoxShape>(btVector3(half, half, half)), 0,
                  btVector3(0, btScalar(height) - half, 0));
}

// A body that the deformable world does not step must not be asked for its forces either.
void CaseScene::takeOut(btSoftBody& body) {
  body.forceActivationState(DISABLE_SIMULATION);
  const WorldKind kind = kindOf(m_world);
  if (kind == WorldKind::softRigid) static_cast<btSoftRigidDynamicsWorld&>(bullet()).removeSoftBody(&body);
  if (kind == WorldKind::softMultiBody) static_cast<btSoftMultiBodyDynamicsWorld&>(bullet()).removeSoftBody(&body);
  if (kind == WorldKind::deformable) static_cast<btDeformableMultiBodyDynamicsWorld&>(bullet()).removeSoftBody(&body);
  clothOf(body).isInWorld = false;
}

void CaseScene::putBack(btSoftBody& body) {
  body.forceActivationState(DISABLE_DEACTIVATION);
  const WorldKind kind = kindOf(m_world);
  if (kind == WorldKind::softRigid) static_cast<btSoftRigidDynamicsWorld&>(bullet()).addSoftBody(&body);
  if (kind == WorldKind::softMultiBody) static_cast<btSoftMultiBodyDynamicsWorld&>(bullet()).addSoftBody(&body);
  if (kind == WorldKind::deformable) static_cast<btDeformableMultiBodyDynamicsWorld&>(bullet()).addSoftBody(&body);
  clothOf(body).isInWorld = true;
}

void CaseScene::setGravity(const btVector3& gravity) {
  bullet().setGravity(gravity);
  worldInfo().m_gravity = gravity;
  if (!isDeformable(m_world)) return;
  for (const Cloth& cloth : m_cloths) {
    auto* solver = static_cast<btDeformableBodySolver*>(cloth.body->getSoftBodySolver());
    if (solver == nullptr) continue;
    const btAlignedObjectArray<btDeformableLagrangianForce*>& forces = solver->m_objective->m_lf;
    for (int i = 0; i < forces.size(); ++i) {
      if (forces[i]->getForceType() == BT_GRAVITY_FORCE) {
        static_cast<btDeformableGravityForce*>(forces[i])->m_gravity = gravity;
      }
    }
  }
}

void CaseScene::begin() {
  for (Cloth& cloth : m_cloths) {
    if (m_way == Way::plainBulletWet) makeHeavy(*cloth.body);
    double sum = 0;
    for (int k = 0; k < cloth.body->m_links.size(); ++k) {
      cloth.restLengths.push_back(double(cloth.body->m_links[k].m_rl));
      sum += cloth.restLengths.back();
    }
    cloth.meanRestLength = cloth.restLengths.empty() ? 0 : sum / static_cast<double>(cloth.restLengths.size());
  }
}

void moveKinematic(btRigidBody& body, const btVector3& position, const btQuaternion& rotation, double dt) {
  const btTransform from = body.getWorldTransform();
  const btTransform to(rotation, position);
  btVector3 linear;
  btVector3 angular;
  btTransformUtil::calculateVelocity(from, to, btScalar(dt), linear, angular);
  body.setLinearVelocity(linear);
  body.setAngularVelocity(angular);
  body.setInterpolationLinearVelocity(linear);
  body.setInterpolationAngularVelocity(angular);
  body.setWorldTransform(to);
  body.setInterpolationWorldTransform(to);
}

}  // namespace stability
