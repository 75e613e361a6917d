// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/ContactList.h"
#include "bullet_wetcloth/solver/ConvexHulls.h"
#include "bullet_wetcloth/solver/LocalNodes.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletSoftBody/btSoftBody.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Finds the nodes of a cloth that would be in a rigid body, or a link of a multibody, at the end of the step, and
/// lists them as Bullet does: btSoftBody::m_rcontacts. Boxes, spheres, capsules, cylinders and planes by their closed
/// forms, hulls of points by their sides; other shapes by Bullet's own test of a node, which reads distances from a
/// grid of 8 cm.
class RigidDetection {
 public:
  /// A new step: no object was looked at, and nothing touches the body.
  void begin(btSoftBody& body);
  /// Looks at an object, whose prediction by `nodes` has been made.
  void detect(btSoftBody& body, LocalNodes& nodes, const btCollisionObjectWrapper& object);

 private:
  ContactList m_contacts;
  ConvexHulls m_hulls;
  const btCollisionObject* m_plane = nullptr;  // Bullet shows a plane once for each of its two triangles
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
