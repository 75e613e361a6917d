// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/ContactProjection.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

int degreesOfFreedom(const btMultiBodyLinkCollider& link) { return link.m_multiBody->getNumDofs() + 6; }

}  // namespace

void ContactProjection::prepare(const btSoftBody& body, const LocalNodes& nodes, int smallSteps) {
  m_fixed.clear();
  m_contacts.clear();
  m_jacobians.clear();
  m_margin = body.getCollisionShape()->getMargin();
  const btScalar perIteration = static_cast<btScalar>(body.m_cfg.piterations) / static_cast<btScalar>(smallSteps);
  btScalar leftInAll = 1;  // of the slipping, by the last contact: most are alike
  btScalar left = 1;
  for (int k = 0; k < body.m_rcontacts.size(); ++k) {
    const btSoftBody::RContact& listed = body.m_rcontacts[k];
    const int node = findIndex(body.m_nodes, static_cast<const btSoftBody::Node*>(listed.m_node));
    if (node < 0 || !listed.m_cti.m_colObj->hasContactResponse()) continue;
    if (listed.m_c3 != leftInAll) {
      leftInAll = listed.m_c3;
      left = std::pow(std::max(leftInAll, btScalar(0)), perIteration);
    }
    const std::size_t slot = nodes.slot(toSize(node));
    const btScalar offset = listed.m_cti.m_offset + listed.m_cti.m_normal.dot(nodes.origin());
    const btScalar recovers = listed.m_c4 / static_cast<btScalar>(smallSteps);
    auto* const object = const_cast<btCollisionObject*>(listed.m_cti.m_colObj);
    btRigidBody* const rigid = btRigidBody::upcast(object);
    btMultiBodyLinkCollider* const link = btMultiBodyLinkCollider::upcast(object);
    if (!link && !(rigid && rigid->getInvMass() > 0)) {
      const btVector3 velocity = rigid ? rigid->getVelocityInLocalPoint(listed.m_c1) : btVector3(0, 0, 0);
      m_fixed.push_back({slot, listed.m_cti.m_normal, velocity, offset, left, recovers});
      continue;
    }
    Contact contact = {};
    contact.slot = slot;
    contact.normal = listed.m_cti.m_normal;
    contact.offset = offset;
    contact.moves = listed.m_c0.scaled(btVector3(1, 1, 1) * listed.m_c2);
    contact.pushes = listed.m_c0.scaled(btVector3(1, 1, 1) * body.m_sst.sdt);
    contact.slips = left;
    contact.recovers = recovers;
    contact.arm = listed.m_c1;
    contact.rigid = rigid;
    contact.link = link;
    if (contact.link) addJacobian(contact, listed.m_node->m_x);
    m_contacts.push_back(contact);
  }
}

void ContactProjection::addJacobian(Contact& contact, const btVector3& place) {
  const int degrees = degreesOfFreedom(*contact.link);
  contact.firstJacobian = m_jacobians.size();
  m_jacobians.resize(m_jacobians.size() + 2 * toSize(degrees));
  btScalar* const jacobian = m_jacobians.data() + contact.firstJacobian;
  btMultiBody& multiBody = *contact.link->m_multiBody;
  multiBody.fillContactJacobianMultiDof(contact.link->m_link, place, contact.normal, jacobian, m_scratch.scratch_r,
                                        m_scratch.scratch_v, m_scratch.scratch_m);
  multiBody.calcAccelerationDeltasMultiDof(jacobian, jacobian + degrees, m_scratch.scratch_r, m_scratch.scratch_v);
}

btVector3 ContactProjection::velocityOf(const Contact& contact) const {
  if (contact.rigid) return contact.rigid->getVelocityInLocalPoint(contact.arm);
  if (!contact.link) return btVector3(0, 0, 0);
  const btScalar* const jacobian = m_jacobians.data() + contact.firstJacobian;
  btScalar along = 0;
  for (int k = 0; k < degreesOfFreedom(*contact.link); ++k) {
    along += contact.link->m_multiBody->getVelocityVector()[k] * jacobian[k];
  }
  return contact.normal * along;
}

// Bullet's position solver gives a multibody half of the impulse, along the normal.
void ContactProjection::push(const Contact& contact, const btVector3& impulse) {
  if (contact.rigid) contact.rigid->applyImpulse(impulse, contact.arm);
  if (!contact.link) return;
  const btScalar* const response = m_jacobians.data() + contact.firstJacobian + degreesOfFreedom(*contact.link);
  contact.link->m_multiBody->applyDeltaVeeMultiDof(response, impulse.length() * btScalar(-0.5));
}

void ContactProjection::project(const MovingNodes& nodes, btScalar h) {
  projectFixed(nodes, h);
  projectMovable(nodes, h);
}

void ContactProjection::projectFixed(const MovingNodes& nodes, btScalar h) {
  for (FixedContact& contact : m_fixed) {
    const std::size_t i = contact.slot;
    const btVector3 carried = contact.velocity * h;
    contact.offset -= carried.dot(contact.normal);
    const btVector3 relative = nodes.wayOf(i, h) - carried;
    const btScalar approach = relative.dot(contact.normal);
    if (approach > SIMD_EPSILON) continue;
    const btScalar gap = std::min(nodes.placeOf(i).dot(contact.normal) + contact.offset, m_margin);
    const btVector3 slip = relative - contact.normal * approach;
    const btVector3 moved = relative - slip * contact.slips + contact.normal * (gap * contact.recovers);
    for (int axis = 0; axis < 3; ++axis) nodes.position[axis][i] -= moved[axis];
  }
}

void ContactProjection::projectMovable(const MovingNodes& nodes, btScalar h) {
  for (Contact& contact : m_contacts) {
    const std::size_t i = contact.slot;
    const btVector3 place = nodes.placeOf(i);
    const btVector3 carried = velocityOf(contact) * h;
    contact.offset -= carried.dot(contact.normal);
    const btVector3 relative = nodes.wayOf(i, h) - carried;
    const btScalar approach = relative.dot(contact.normal);
    if (approach > SIMD_EPSILON) continue;
    const btScalar gap = std::min(place.dot(contact.normal) + contact.offset, m_margin);
    const btVector3 slip = relative - contact.normal * approach;
    const btVector3 excess = relative - slip * contact.slips + contact.normal * (gap * contact.recovers);
    const btVector3 moved = contact.moves * excess;
    for (int axis = 0; axis < 3; ++axis) nodes.position[axis][i] -= moved[axis];
    push(contact, contact.pushes * excess / h);
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
