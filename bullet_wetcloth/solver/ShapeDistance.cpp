// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/ShapeDistance.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
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

}  // namespace

bool MeasuredShape::isOne(const btCollisionShape& shape) {
  const int type = shape.getShapeType();
  return type == BOX_SHAPE_PROXYTYPE || type == SPHERE_SHAPE_PROXYTYPE || type == STATIC_PLANE_PROXYTYPE;
}

MeasuredShape::MeasuredShape(const btCollisionShape& shape)
    : m_type(shape.getShapeType()), m_extent(0, 0, 0), m_size(0) {
  if (m_type == BOX_SHAPE_PROXYTYPE) {
    m_extent = static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin();
  } else if (m_type == SPHERE_SHAPE_PROXYTYPE) {
    m_size = static_cast<const btSphereShape&>(shape).getRadius();
  } else {
    m_extent = static_cast<const btStaticPlaneShape&>(shape).getPlaneNormal();
    m_size = static_cast<const btStaticPlaneShape&>(shape).getPlaneConstant();
  }
}

ShapeDistance MeasuredShape::distanceTo(const btVector3& point) const {
  if (m_type == BOX_SHAPE_PROXYTYPE) return distanceToBox(m_extent, point);
  if (m_type == SPHERE_SHAPE_PROXYTYPE) return distanceToSphere(m_size, point);
  return {m_extent.dot(point) - m_size, m_extent};
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
