// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/drops/BodyTargets.h"

#include "bullet_wetcloth/state/StateArchive.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

bool isTarget(const btCollisionObject& object) {
  return object.getInternalType() != btCollisionObject::CO_SOFT_BODY && object.hasContactResponse() &&
         object.getCollisionShape();
}

bool isFinitePlace(const btTransform& transform) {
  const btMatrix3x3& basis = transform.getBasis();
  return std::isfinite(transform.getOrigin().length2() + basis[0].length2() + basis[1].length2() + basis[2].length2());
}

SweptBox boxOf(const btCollisionObject& object, const btTransform& before, const btTransform& now) {
  SweptBox box;
  for (const btTransform* place : {&before, &now}) {
    btVector3 low, high;
    object.getCollisionShape()->getAabb(*place, low, high);
    SweptBox at;
    for (int k = 0; k < 3; ++k) {
      at.low[k] = static_cast<float>(low[k]);
      at.high[k] = static_cast<float>(high[k]);
    }
    box.include(at);
  }
  return box;
}

// Bullet's own test takes a plane for two triangles, and lets a drop through that rounding has put below it.
double timeOfPlane(const DropPath& path, const btStaticPlaneShape& plane) {
  const Double3 normal = asDouble(plane.getPlaneNormal());
  double heightBefore = -static_cast<double>(plane.getPlaneConstant());
  double heightAfter = heightBefore;
  for (std::size_t k = 0; k < 3; ++k) {
    heightBefore += normal[k] * path.from[k];
    heightAfter += normal[k] * path.to[k];
  }
  if (heightBefore <= 0) return 0;
  return heightAfter > 0 ? 2 : heightBefore / (heightBefore - heightAfter);
}

// From a little before, for a drop that rounding has put just inside: Bullet's rays leave a body unseen.
double timeOfRay(const DropPath& path, const btCollisionObject& object, btVector3& normal) {
  constexpr double ahead = 1e-4;  // [m]
  double length = 0;
  for (std::size_t k = 0; k < 3; ++k) length += (path.to[k] - path.from[k]) * (path.to[k] - path.from[k]);
  length = std::sqrt(length);
  if (!(length > 0)) return 2;
  const double before = ahead / length;
  const btTransform from(btQuaternion::getIdentity(), asBullet(path.at(-before)));
  const btTransform to(btQuaternion::getIdentity(), asBullet(path.to));
  const btTransform none = btTransform::getIdentity();
  btCollisionWorld::ClosestRayResultCallback nearest(from.getOrigin(), to.getOrigin());
  nearest.m_flags |= btTriangleRaycastCallback::kF_UseGjkConvexCastRaytest;
  btCollisionWorld::rayTestSingle(from, to, const_cast<btCollisionObject*>(&object), object.getCollisionShape(), none,
                                  nearest);
  if (!nearest.hasHit()) return 2;
  normal = nearest.m_hitNormalWorld;
  const double fraction = static_cast<double>(nearest.m_closestHitFraction);
  return std::max(0.0, fraction * (1 + before) - before);
}

Double3 transformed(const btTransform& transform, const Double3& place) {
  const Double3 origin = asDouble(transform.getOrigin());
  Double3 result;
  for (std::size_t k = 0; k < 3; ++k) {
    const Double3 row = asDouble(transform.getBasis()[static_cast<int>(k)]);
    result[k] = row[0] * place[0] + row[1] * place[1] + row[2] * place[2] + origin[k];
  }
  return result;
}

// The same of the inverse of a transform without scale, in double.
Double3 inverselyTransformed(const btTransform& transform, const Double3& place) {
  const Double3 origin = asDouble(transform.getOrigin());
  Double3 result = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const Double3 row = asDouble(transform.getBasis()[static_cast<int>(k)]);
    for (std::size_t axis = 0; axis < 3; ++axis) result[axis] += row[axis] * (place[k] - origin[k]);
  }
  return result;
}

}  // namespace

void BodyTargets::restart(const btCollisionWorld& world) {
  m_bodies.clear();
  advance(world);
}

void BodyTargets::advance(const btCollisionWorld& world) {
  m_last.swap(m_bodies);
  m_bodies.clear();
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  for (int i = 0; i < objects.size(); ++i) {
    const btCollisionObject& object = *objects[i];
    const btTransform& now = object.getWorldTransform();
    if (!isTarget(object) || !isFinitePlace(now)) continue;
    const Body* const last = find(&object, m_bodies.size());
    const btTransform& before = last ? last->now : now;
    m_bodies.push_back({&object, before, now});
  }
  m_boxes.resize(SweptBoxes::wholeBlocks(m_bodies.size()));
  for (std::size_t i = 0; i < m_boxes.size(); ++i) {
    m_boxes.set(i, i < m_bodies.size() ? boxOf(*m_bodies[i].object, m_bodies[i].before, m_bodies[i].now) : SweptBox());
  }
}

// Nearly always it stands where it stood in the last substep.
const BodyTargets::Body* BodyTargets::find(const btCollisionObject* object, std::size_t guess) const {
  if (guess < m_last.size() && m_last[guess].object == object) return &m_last[guess];
  const auto isIt = [&](const Body& body) { return body.object == object; };
  const auto found = std::find_if(m_last.begin(), m_last.end(), isIt);
  return found == m_last.end() ? nullptr : &*found;
}

BodyTargets::Hit BodyTargets::firstHit(const DropPath& path) const {
  Hit best;
  const SweptBox box = path.box();
  int found[SweptBoxes::kMost];
  for (std::size_t begin = 0; begin < m_boxes.size(); begin += SweptBoxes::kMost) {
    const std::size_t end = std::min(begin + SweptBoxes::kMost, m_boxes.size());
    const std::size_t count = m_boxes.findOverlapping(box, begin, end, found);
    for (std::size_t i = 0; i < count; ++i) consider(path, m_bodies[static_cast<std::size_t>(found[i])], best);
  }
  return best;
}

// In the body's own frame, in which only the drop moves.
void BodyTargets::consider(const DropPath& path, const Body& body, Hit& best) const {
  const DropPath local = {inverselyTransformed(body.before, path.from), inverselyTransformed(body.now, path.to)};
  const btCollisionShape& shape = *body.object->getCollisionShape();
  btVector3 normal(0, 0, 0);
  if (shape.getShapeType() == STATIC_PLANE_PROXYTYPE) {
    normal = static_cast<const btStaticPlaneShape&>(shape).getPlaneNormal();
  }
  const double time = shape.getShapeType() == STATIC_PLANE_PROXYTYPE
                          ? timeOfPlane(local, static_cast<const btStaticPlaneShape&>(shape))
                          : timeOfRay(local, *body.object, normal);
  if (!(time < best.time)) return;
  best = {time, body.object, transformed(body.now, local.at(time)), asDouble(body.now.getBasis() * normal)};
}

void BodyTargets::transferState(StateArchive& archive) {
  archive.growing(m_bodies, [&](Body& body) {
    archive.object(body.object);
    archive.value(body.before, body.now);
  });
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
