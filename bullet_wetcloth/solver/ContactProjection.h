// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/LocalNodes.h"

#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <BulletSoftBody/btSoftBody.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Contacts of a cloth's nodes with rigid bodies and links of multibodies, in small steps: the law of Bullet's own
/// position solver, whose planes move with the bodies. Both sides feel it.
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
  // With what no impulse moves: its velocity is the same in all small steps.
  struct FixedContact {
    std::size_t slot;
    btVector3 normal;
    btVector3 velocity;  // of what is touched
    btScalar offset;     // of the plane, which moves with it; places are those of the arrays
    btScalar slips;      // share of the slipping that stays in a small step
    btScalar recovers;   // share of the depth that goes in a small step
  };
  struct Contact {
    std::size_t slot;
    btVector3 normal;
    btScalar offset;     // of the plane, which moves with the body; places are those of the arrays
    btMatrix3x3 moves;   // how far the node moves per distance to be taken away
    btMatrix3x3 pushes;  // impulse per the same, times the small step [kg]
    btScalar slips;      // share of the slipping that stays in a small step
    btScalar recovers;   // share of the depth that goes in a small step
    btRigidBody* rigid;
    btVector3 arm;
    btMultiBodyLinkCollider* link;
    std::size_t firstJacobian;  // of the link
  };

  void projectFixed(const MovingNodes& nodes, btScalar h);
  void projectMovable(const MovingNodes& nodes, btScalar h);
  void addJacobian(Contact& contact, const btVector3& place);
  btVector3 velocityOf(const Contact& contact) const;
  void push(const Contact& contact, const btVector3& impulse);

  std::vector<FixedContact> m_fixed;
  std::vector<Contact> m_contacts;
  btScalar m_margin = 0;
  std::vector<btScalar> m_jacobians;  // for each link that is touched: its Jacobian, and what a unit impulse does
  btMultiBodyJacobianData m_scratch;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
