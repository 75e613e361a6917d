// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/bullet/ShapeReach.h"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btConvexPointCloudShape.h>
#include <BulletCollision/CollisionShapes/btTriangleCallback.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// BT_SOFTBODY_TRIANGLE_EXTRUSION, which Bullet keeps in a source file [m].
constexpr btScalar kExtrusion = btScalar(0.06);

// Where GJK gives up, the point is on the core of the shape.
bool isNearConvex(const btConvexShape& shape, const btVector3& point, btScalar reach) {
  btGjkEpaSolver2::sResults results;
  const btScalar distance = btGjkEpaSolver2::SignedDistance(point, 0, &shape, btTransform::getIdentity(), results);
  return distance <= reach || distance == SIMD_INFINITY;
}

class NearTriangle : public btTriangleCallback {
 public:
  NearTriangle(const btVector3& point, btScalar reach) : m_point(point), m_reach(reach) {}
  bool isFound() const { return m_isFound; }

  // As btSoftBodyTriangleCallback builds it, but without taking memory.
  void processTriangle(btVector3* corners, int, int) override {
    if (m_isFound) return;
    const btVector3 across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (!(across.length2() > 0)) return;
    const btVector3 normal = across.normalized() * kExtrusion;
    btVector3 points[6] = {corners[0] + normal, corners[1] + normal, corners[2] + normal,
                           corners[0] - normal, corners[1] - normal, corners[2] - normal};
    const btConvexPointCloudShape prism(points, 6, btVector3(1, 1, 1));
    m_isFound = isNearConvex(prism, m_point, m_reach);
  }

 private:
  btVector3 m_point;
  btScalar m_reach;
  bool m_isFound = false;
};

bool isNearTriangles(const btConcaveShape& shape, const btVector3& point, btScalar reach) {
  const btScalar most = reach + kExtrusion + CONVEX_DISTANCE_MARGIN;
  const btVector3 around(most, most, most);
  NearTriangle near(point, reach);
  shape.processAllTriangles(&near, point - around, point + around);
  return near.isFound();
}

bool isNearChild(const btCompoundShape& shape, const btVector3& point, btScalar reach) {
  for (int i = 0; i < shape.getNumChildShapes(); ++i) {
    if (isWithinReach(*shape.getChildShape(i), shape.getChildTransform(i).invXform(point), reach)) return true;
  }
  return false;
}

bool isInBox(const btCollisionShape& shape, const btVector3& point, btScalar reach) {
  btVector3 low;
  btVector3 high;
  shape.getAabb(btTransform::getIdentity(), low, high);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(point[axis] >= low[axis] - reach && point[axis] <= high[axis] + reach)) return false;
  }
  return true;
}

}  // namespace

bool isWithinReach(const btCollisionShape& shape, const btVector3& point, btScalar reach) {
  if (shape.isConcave()) return isNearTriangles(static_cast<const btConcaveShape&>(shape), point, reach);
  if (!isInBox(shape, point, reach)) return false;
  if (shape.isCompound()) return isNearChild(static_cast<const btCompoundShape&>(shape), point, reach);
  return shape.isConvex() && isNearConvex(static_cast<const btConvexShape&>(shape), point, reach);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
