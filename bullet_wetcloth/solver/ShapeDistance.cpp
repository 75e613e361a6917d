// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/ShapeDistance.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

ShapeDistance distanceToBox(const btVector3& halfExtents, const btVector3& point) {
  const btVector3 beyond = point.absolute() - halfExtents;
  const btVector3 out(std::max(beyond.x(), btScalar(0)), std::max(beyond.y(), btScalar(0)),
                      std::max(beyond.z(), btScalar(0)));
  const btScalar distance = out.length();
  btVector3 normal(0, 0, 0);
  if (distance > 0) {
    for (int axis = 0; axis < 3; ++axis) normal[axis] = std::copysign(out[axis] / distance, point[axis]);
    return {distance, normal};
  }
  const int nearest = beyond.maxAxis();
  normal[nearest] = std::copysign(btScalar(1), point[nearest]);
  return {beyond[nearest], normal};
}

ShapeDistance distanceToSphere(btScalar radius, const btVector3& point) {
  const btScalar length = point.length();
  const btVector3 up(0, 1, 0);  // from the centre all ways out are as long
  return {length - radius, length > 0 ? point / length : up};
}

/// From the part of an axis through the origin that is within half a length of it.
ShapeDistance distanceToCapsule(int axis, btScalar half, btScalar radius, const btVector3& point) {
  btVector3 out = point;
  out[axis] -= std::max(-half, std::min(half, point[axis]));
  const btScalar length = out.length();
  btVector3 sideways(0, 0, 0);  // from the axis all ways out are as long
  sideways[(axis + 1) % 3] = 1;
  return {length - radius, length > 0 ? out / length : sideways};
}

/// As of a rectangle: beside the axis and along it.
ShapeDistance distanceToCylinder(int axis, btScalar half, btScalar radius, const btVector3& point) {
  btVector3 beside = point;
  beside[axis] = 0;
  const btScalar reach = beside.length();
  btVector3 outwards(0, 0, 0);
  outwards[(axis + 1) % 3] = 1;
  if (reach > 0) outwards = beside / reach;
  btVector3 up(0, 0, 0);
  up[axis] = std::copysign(btScalar(1), point[axis]);
  const btScalar past = reach - radius;
  const btScalar over = std::fabs(point[axis]) - half;
  if (past > 0 && over > 0) {
    const btVector3 out = outwards * past + up * over;
    const btScalar distance = out.length();
    return {distance, out / distance};
  }
  return past > over ? ShapeDistance{past, outwards} : ShapeDistance{over, up};
}

bool isRoundCylinder(const btCollisionShape& shape) {
  if (shape.getShapeType() != CYLINDER_SHAPE_PROXYTYPE) return false;
  const auto& cylinder = static_cast<const btCylinderShape&>(shape);
  const btVector3 half = cylinder.getHalfExtentsWithMargin();
  const int axis = cylinder.getUpAxis();
  return half[(axis + 1) % 3] == half[(axis + 2) % 3];
}

}  // namespace

bool MeasuredShape::isOne(const btCollisionShape& shape) {
  const int type = shape.getShapeType();
  return type == BOX_SHAPE_PROXYTYPE || type == SPHERE_SHAPE_PROXYTYPE || type == STATIC_PLANE_PROXYTYPE ||
         type == CAPSULE_SHAPE_PROXYTYPE || isRoundCylinder(shape);
}

MeasuredShape::MeasuredShape(const btCollisionShape& shape)
    : m_type(shape.getShapeType()), m_extent(0, 0, 0), m_size(0), m_half(0) {
  if (m_type == BOX_SHAPE_PROXYTYPE) {
    m_extent = static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin();
  } else if (m_type == SPHERE_SHAPE_PROXYTYPE) {
    m_size = static_cast<const btSphereShape&>(shape).getRadius();
  } else if (m_type == CAPSULE_SHAPE_PROXYTYPE) {
    const auto& capsule = static_cast<const btCapsuleShape&>(shape);
    m_axis = capsule.getUpAxis();
    m_size = capsule.getRadius();
    m_half = capsule.getHalfHeight();
  } else if (m_type == CYLINDER_SHAPE_PROXYTYPE) {
    const auto& cylinder = static_cast<const btCylinderShape&>(shape);
    m_axis = cylinder.getUpAxis();
    m_half = cylinder.getHalfExtentsWithMargin()[m_axis];
    m_size = cylinder.getHalfExtentsWithMargin()[(m_axis + 1) % 3];
  } else {
    m_extent = static_cast<const btStaticPlaneShape&>(shape).getPlaneNormal();
    m_size = static_cast<const btStaticPlaneShape&>(shape).getPlaneConstant();
  }
}

ShapeDistance MeasuredShape::distanceTo(const btVector3& point) const {
  if (m_type == BOX_SHAPE_PROXYTYPE) return distanceToBox(m_extent, point);
  if (m_type == SPHERE_SHAPE_PROXYTYPE) return distanceToSphere(m_size, point);
  if (m_type == CAPSULE_SHAPE_PROXYTYPE) return distanceToCapsule(m_axis, m_half, m_size, point);
  if (m_type == CYLINDER_SHAPE_PROXYTYPE) return distanceToCylinder(m_axis, m_half, m_size, point);
  return {m_extent.dot(point) - m_size, m_extent};
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
