// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/RigidDetection.h"

#include "bullet_wetcloth/bullet/ImpulseMatrix.h"
#include "bullet_wetcloth/solver/ShapeDistance.h"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletSoftBody/btSoftBodyInternals.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

btRigidBody* rigidOf(const btCollisionObjectWrapper& object) {
  return const_cast<btRigidBody*>(btRigidBody::upcast(object.getCollisionObject()));
}

bool isPlane(const btCollisionObject& object) {
  return object.getCollisionShape()->getShapeType() == STATIC_PLANE_PROXYTYPE;
}

// Of triangles Bullet shows a new hull in each step; these are not kept.
bool isOwnHull(const btCollisionShape& shape, const btCollisionShape& root) {
  if (shape.getShapeType() != CONVEX_HULL_SHAPE_PROXYTYPE) return false;
  if (root.getShapeType() != COMPOUND_SHAPE_PROXYTYPE) return &shape == &root;
  const auto& compound = static_cast<const btCompoundShape&>(root);
  for (int k = 0; k < compound.getNumChildShapes(); ++k) {
    if (compound.getChildShape(k) == &shape) return true;
  }
  return false;
}

// A hull and Bullet's margin around it.
class MeasuredHull {
 public:
  /// @param reach  [m]: nothing is asked of what is farther away
  MeasuredHull(const HullPlanes& planes, btScalar margin, btScalar reach)
      : m_planes(planes), m_margin(margin), m_enough(kBeyondRounding * (margin + reach)) {}
  ShapeDistance distanceTo(const btVector3& point) const {
    const ShapeDistance found = m_planes.distanceTo(point, m_enough, m_likely);
    return {found.distance - m_margin, found.normal};
  }

 private:
  static constexpr btScalar kBeyondRounding = btScalar(1.001);

  const HullPlanes& m_planes;
  btScalar m_margin;
  btScalar m_enough;
  mutable std::size_t m_likely = 0;  // plane, by the point before
};

// Lists contacts of one object whose distance is measured.
template <class Shape>
class MeasuredContacts {
 public:
  MeasuredContacts(btSoftBody& body, ContactList& contacts, const btCollisionObject& object, const Shape& shape,
                   const btTransform& pose)
      : m_body(body), m_contacts(contacts), m_object(object), m_shape(shape), m_pose(pose) {
    m_rigid = const_cast<btRigidBody*>(btRigidBody::upcast(&object));
    m_isMovable = m_rigid && m_rigid->getInvMass() > 0;
    m_margin = body.getCollisionShape()->getMargin();
    m_friction = body.m_cfg.kDF * object.getFriction();
    m_hardness = object.isStaticOrKinematicObject() ? body.m_cfg.kKHR : body.m_cfg.kCHR;
  }

  void test(btSoftBody::Node& node) const {
    if (node.m_battach || !(node.m_im > 0 || m_isMovable)) return;
    const ShapeDistance found = m_shape.distanceTo(m_pose.invXform(node.m_x));
    const btScalar depth = found.distance - m_margin;
    if (depth < 0) list(node, m_pose.getBasis() * found.normal, depth);
  }

 private:
  void list(btSoftBody::Node& node, const btVector3& normal, btScalar depth) const {
    btSoftBody::RContact& contact = m_contacts.add(m_body);
    const btScalar dt = m_body.m_sst.sdt;
    contact.m_cti.m_colObj = &m_object;
    contact.m_cti.m_normal = normal;
    contact.m_cti.m_offset = depth - normal.dot(node.m_x);
    contact.m_node = &node;
    contact.m_c1 = node.m_x - m_pose.getOrigin();
    contact.m_c2 = node.m_im * dt;
    contact.m_c0 = impulsePerWay(node.m_im, contact.m_c1);
    const btVector3 carried = m_rigid ? m_rigid->getVelocityInLocalPoint(contact.m_c1) * dt : btVector3(0, 0, 0);
    const btVector3 relative = node.m_x - node.m_q - carried;
    const btScalar approach = relative.dot(normal);
    const btScalar held = approach * m_friction;  // of the slipping, by Coulomb
    const bool sticks = (relative - normal * approach).length2() < held * held;
    contact.m_c3 = sticks ? 0 : 1 - m_friction;
    contact.m_c4 = m_hardness;
    if (m_isMovable) m_rigid->activate();
  }

  btMatrix3x3 impulsePerWay(btScalar inverseMass, const btVector3& arm) const {
    const btScalar perStep = m_body.m_sst.isdt;
    if (m_isMovable) {
      return impulseMatrix(inverseMass, *m_rigid, arm).scaled(btVector3(1, 1, 1) * perStep);
    }
    const btScalar mass = perStep / inverseMass;
    return btMatrix3x3(mass, 0, 0, 0, mass, 0, 0, 0, mass);
  }

  btSoftBody& m_body;
  ContactList& m_contacts;
  const btCollisionObject& m_object;
  const Shape& m_shape;
  const btTransform& m_pose;
  btRigidBody* m_rigid;
  bool m_isMovable;  // by an impulse
  btScalar m_margin;
  btScalar m_friction;
  btScalar m_hardness;
};

}  // namespace

void RigidDetection::begin(btSoftBody& body) {
  m_plane = nullptr;
  m_contacts.begin(body);
  m_hulls.endStep();
}

void RigidDetection::detect(btSoftBody& body, LocalNodes& nodes, const btCollisionObjectWrapper& object) {
  const btCollisionObject& root = *object.getCollisionObject();
  const bool isOfPlane = isPlane(root);
  if (isOfPlane && m_plane == &root) return;
  if (isOfPlane) m_plane = &root;
  const btCollisionShape& shape = isOfPlane ? *root.getCollisionShape() : *object.getCollisionShape();
  const btTransform& pose = isOfPlane ? root.getWorldTransform() : object.getWorldTransform();
  const btScalar margin = body.getCollisionShape()->getMargin();
  const btVector3 around = btVector3(1, 1, 1) * margin;
  btVector3 least;
  btVector3 largest;
  shape.getAabb(pose, least, largest);
  const auto testEachBy = [&](const auto& measured) {
    const MeasuredContacts contacts(body, m_contacts, root, measured, pose);
    nodes.forEachPredictedIn(least - around, largest + around, [&](btSoftBody::Node& node) { contacts.test(node); });
  };
  if (MeasuredShape::isOne(shape)) return testEachBy(MeasuredShape(shape));
  if (isOwnHull(shape, *root.getCollisionShape())) {
    const auto& hull = static_cast<const btConvexHullShape&>(shape);
    const HullPlanes& sides = m_hulls.of(hull).sides;
    if (!sides.isEmpty()) return testEachBy(MeasuredHull(sides, hull.getMargin(), margin));
  }
  btSoftColliders::CollideSDF_RS test;
  test.psb = &body;
  test.m_colObj1Wrap = &object;
  test.m_rigidBody = rigidOf(object);
  test.dynmargin = margin;
  test.stamargin = margin;
  nodes.forEachPredictedIn(least - around, largest + around, [&](btSoftBody::Node& node) { test.DoNode(node); });
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
