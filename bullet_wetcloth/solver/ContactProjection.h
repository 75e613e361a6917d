// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/FixedContacts.h"
#include "bullet_wetcloth/solver/LocalNodes.h"

#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <BulletSoftBody/btSoftBody.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Contacts of a cloth's nodes with rigid bodies and links of multibodies, in small steps: the law of Bullet's own
/// position solver, whose planes move with the bodies. Both sides feel it; a link of a multibody as a rigid body does,
/// where Bullet gives it half of the impulse, and none of the friction.
///
/// What Bullet does once an iteration is done once a small step here. So of what it takes away in all iterations
/// (slipping, depth of penetration), each small step takes its share.
class ContactProjection {
 public:
  /// The contacts that Bullet lists for the body in this step, which has so many small steps.
  void prepare(const btSoftBody& body, const LocalNodes& nodes, int smallSteps);
  /// How many there are.
  std::size_t size() const { return m_fixed.size() + m_contacts.size(); }
  /// Moves the nodes that approach what they touch, in a small step of h [s].
  void project(const MovingNodes& nodes, btScalar h);

 private:
  struct Contact : PlaneContact {
    btMatrix3x3 moves;   // how far the node moves per distance to be taken away
    btMatrix3x3 pushes;  // impulse on the body per the same, times the small step [kg]
    btRigidBody* rigid;
    btVector3 arm;
    btMultiBodyLinkCollider* link;
    std::size_t firstJacobian;  // of the link, in m_jacobians
  };

  void projectMovable(const MovingNodes& nodes, btScalar h);
  void addRigid(const PlaneContact& plane, const btSoftBody::RContact& listed, btRigidBody& rigid, btScalar dt);
  void addLink(const PlaneContact& plane, const btSoftBody::Node& node, btMultiBodyLinkCollider& link);
  btVector3 velocityOf(const Contact& contact) const;
  void push(const Contact& contact, const btVector3& impulse);

  FixedContacts m_fixed;
  std::vector<Contact> m_contacts;
  btScalar m_margin = 0;
  std::vector<btScalar> m_jacobians;  // for each contact with a link and each axis: the point's velocity by those of
                                      // the joints, and how these change by a unit impulse there
  btMultiBodyJacobianData m_scratch;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
