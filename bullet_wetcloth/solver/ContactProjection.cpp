// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/ContactProjection.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Of the slipping, what stays in one of several small steps. Most contacts are alike.
class SlipShare {
 public:
  explicit SlipShare(btScalar iterationsPerSmallStep) : m_exponent(iterationsPerSmallStep) {}
  btScalar of(btScalar leftInIteration) {
    if (leftInIteration != m_left) {
      m_left = leftInIteration;
      m_share = std::pow(std::max(leftInIteration, btScalar(0)), m_exponent);
    }
    return m_share;
  }

 private:
  btScalar m_exponent;
  btScalar m_left = 1;
  btScalar m_share = 1;
};

int degreesOfFreedom(const btMultiBodyLinkCollider& link) { return link.m_multiBody->getNumDofs() + 6; }

btScalar product(const btScalar* a, const btScalar* b, int count) {
  btScalar sum = 0;
  for (int k = 0; k < count; ++k) sum += a[k] * b[k];
  return sum;
}

}  // namespace

void ContactProjection::prepare(const btSoftBody& body, const LocalNodes& nodes, int smallSteps) {
  m_fixed.reset(body.m_rcontacts.size() > 0 ? nodes.size() : 0);
  m_contacts.clear();
  m_jacobians.clear();
  m_margin = body.getCollisionShape()->getMargin();
  SlipShare slips(static_cast<btScalar>(body.m_cfg.piterations) / static_cast<btScalar>(smallSteps));
  for (int k = 0; k < body.m_rcontacts.size(); ++k) {
    const btSoftBody::RContact& listed = body.m_rcontacts[k];
    const int node = findIndex(body.m_nodes, static_cast<const btSoftBody::Node*>(listed.m_node));
    if (node < 0 || !listed.m_cti.m_colObj->hasContactResponse()) continue;
    const btVector3& normal = listed.m_cti.m_normal;
    const btScalar offset = listed.m_cti.m_offset + normal.dot(nodes.origin());
    const btScalar recovers = listed.m_c4 / static_cast<btScalar>(smallSteps);
    const PlaneContact plane = {nodes.slot(toSize(node)), normal, offset, slips.of(listed.m_c3), recovers};
    auto* const object = const_cast<btCollisionObject*>(listed.m_cti.m_colObj);
    btRigidBody* const rigid = btRigidBody::upcast(object);
    btMultiBodyLinkCollider* const link = btMultiBodyLinkCollider::upcast(object);
    if (m_contacts.empty() && (rigid || link)) m_contacts.reserve(toSize(body.m_nodes.size()));
    if (link) {
      addLink(plane, *listed.m_node, *link);
    } else if (rigid && rigid->getInvMass() > 0) {
      addRigid(plane, listed, *rigid, body.m_sst.sdt);
    } else {
      m_fixed.add(plane, rigid ? rigid->getVelocityInLocalPoint(listed.m_c1) : btVector3(0, 0, 0));
    }
  }
}

void ContactProjection::addRigid(const PlaneContact& plane, const btSoftBody::RContact& listed, btRigidBody& rigid,
                                 btScalar dt) {
  Contact contact = {};
  static_cast<PlaneContact&>(contact) = plane;
  contact.moves = listed.m_c0.scaled(btVector3(1, 1, 1) * listed.m_c2);
  contact.pushes = listed.m_c0.scaled(btVector3(1, 1, 1) * dt);
  contact.rigid = &rigid;
  contact.arm = listed.m_c1;
  m_contacts.push_back(contact);
}

// The inverse of how fast node and link part by an impulse between them, along each axis.
void ContactProjection::addLink(const PlaneContact& plane, const btSoftBody::Node& node,
                                btMultiBodyLinkCollider& link) {
  if (!(node.m_im > 0)) return;
  Contact contact = {};
  static_cast<PlaneContact&>(contact) = plane;
  contact.link = &link;
  contact.firstJacobian = m_jacobians.size();
  const int degrees = degreesOfFreedom(link);
  const std::size_t room = 2 * toSize(degrees);
  m_jacobians.resize(m_jacobians.size() + 3 * room);
  btScalar* const jacobians = m_jacobians.data() + contact.firstJacobian;
  btMultiBody& multiBody = *link.m_multiBody;
  multiBody.wakeUp();
  btMatrix3x3 parting(node.m_im, 0, 0, 0, node.m_im, 0, 0, 0, node.m_im);
  for (int axis = 0; axis < 3; ++axis) {
    btVector3 direction(0, 0, 0);
    direction[axis] = 1;
    btScalar* const jacobian = jacobians + toSize(axis) * room;
    multiBody.fillContactJacobianMultiDof(link.m_link, node.m_x, direction, jacobian, m_scratch.scratch_r,
                                          m_scratch.scratch_v, m_scratch.scratch_m);
    multiBody.calcAccelerationDeltasMultiDof(jacobian, jacobian + degrees, m_scratch.scratch_r, m_scratch.scratch_v);
    for (int other = 0; other <= axis; ++other) {
      const btScalar part = product(jacobians + toSize(other) * room, jacobian + degrees, degrees);
      parting[axis][other] += part;
      if (other != axis) parting[other][axis] += part;
    }
  }
  contact.pushes = parting.inverse();
  contact.moves = contact.pushes.scaled(btVector3(1, 1, 1) * node.m_im);
  m_contacts.push_back(contact);
}

btVector3 ContactProjection::velocityOf(const Contact& contact) const {
  if (contact.rigid) return contact.rigid->getVelocityInLocalPoint(contact.arm);
  const int degrees = degreesOfFreedom(*contact.link);
  const btScalar* jacobian = m_jacobians.data() + contact.firstJacobian;
  btVector3 velocity;
  for (int axis = 0; axis < 3; ++axis) {
    velocity[axis] = product(jacobian, contact.link->m_multiBody->getVelocityVector(), degrees);
    jacobian += 2 * toSize(degrees);
  }
  return velocity;
}

void ContactProjection::push(const Contact& contact, const btVector3& impulse) {
  if (contact.rigid) return contact.rigid->applyImpulse(impulse, contact.arm);
  const int degrees = degreesOfFreedom(*contact.link);
  const btScalar* response = m_jacobians.data() + contact.firstJacobian + degrees;
  for (int axis = 0; axis < 3; ++axis) {
    contact.link->m_multiBody->applyDeltaVeeMultiDof(response, impulse[axis]);
    response += 2 * toSize(degrees);
  }
}

void ContactProjection::project(const MovingNodes& nodes, btScalar h) {
  m_fixed.project(nodes, h, m_margin);
  projectMovable(nodes, h);
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
