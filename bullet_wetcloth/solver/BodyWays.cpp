// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/BodyWays.h"

#include "bullet_wetcloth/state/StateArchive.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <LinearMath/btTransformUtil.h>

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// How far from where its velocity says a body may have come, before it counts as put elsewhere [m/s]; [rad/s]. Links of
// a multibody tell no velocity.
constexpr btScalar kUntoldSpeed = 10;
constexpr btScalar kUntoldSpeedOfLink = 100;
constexpr btScalar kUntoldTurn = 60;
// Faster ones are only seen where they were near before [m/s].
constexpr double kFastest = 100;

btVector3 bulletsOf(const BodyPoint& p) {
  return btVector3(static_cast<btScalar>(p[0]), static_cast<btScalar>(p[1]), static_cast<btScalar>(p[2]));
}

BodyBox boxOf(const btCollisionShape& shape, const btTransform& from, const btTransform& to) {
  BodyBox box;
  for (const btTransform* const pose : {&from, &to}) {
    btVector3 low;
    btVector3 high;
    shape.getAabb(*pose, low, high);
    box.include(bodyPointOf(low));
    box.include(bodyPointOf(high));
  }
  return box;
}

bool isFinite(const btTransform& pose) {
  const btVector3& place = pose.getOrigin();
  const btMatrix3x3& basis = pose.getBasis();
  return std::isfinite(place.dot(place)) && std::isfinite(basis.determinant());
}

}  // namespace

// Takes what Bullet finds near a cloth.
class BodyWays::Reader final : public btBroadphaseAabbCallback {
 public:
  Reader(BodyWays& ways, const Place& place, btScalar dt) : m_ways(ways), m_place(place), m_dt(dt) {}
  bool process(const btBroadphaseProxy* proxy) override {
    const auto& object = *static_cast<const btCollisionObject*>(proxy->m_clientObject);
    if (m_ways.isKnown(proxy->m_uniqueId) || !collide(*m_place.cloth, object)) return true;
    const btTransform from = m_ways.startOf(object, proxy->m_uniqueId, m_dt);
    if (!isFinite(from) || !isFinite(object.getWorldTransform())) return true;
    if (!boxOf(*object.getCollisionShape(), from, object.getWorldTransform()).overlaps(m_place.box)) return true;
    m_ways.m_bodies.push_back({&object, proxy->m_uniqueId, from, object.getWorldTransform()});
    return true;
  }

 private:
  BodyWays& m_ways;
  const Place& m_place;
  btScalar m_dt;
};

void BodyWays::find(const std::vector<Place>& places, btScalar dt) {
  m_bodies.clear();
  for (const Place& place : places) {
    if (!place.cloth->getBroadphaseHandle()) continue;
    BodyBox wide = place.box;
    wide.grow(kFastest * static_cast<double>(dt));
    Reader reader(*this, place, dt);
    place.cloth->m_worldInfo->m_broadphase->aabbTest(bulletsOf(wide.low), bulletsOf(wide.high), reader);
  }
  // The broadphase's order is its own.
  std::sort(m_bodies.begin(), m_bodies.end(), [](const Body& a, const Body& b) { return a.proxy < b.proxy; });
}

bool BodyWays::isKnown(int proxy) const {
  return std::any_of(m_bodies.begin(), m_bodies.end(), [&](const Body& body) { return body.proxy == proxy; });
}

bool BodyWays::collide(const btSoftBody& cloth, const btCollisionObject& object) {
  if (object.getInternalType() == btCollisionObject::CO_SOFT_BODY || !object.hasContactResponse()) return false;
  if (object.getInternalType() == btCollisionObject::CO_GHOST_OBJECT || !cloth.hasContactResponse()) return false;
  if ((cloth.m_cfg.collisions & btSoftBody::fCollision::RVSmask) == 0) return false;
  if (cloth.m_collisionDisabledObjects.findLinearSearch(&object) != cloth.m_collisionDisabledObjects.size())
    return false;
  const btBroadphaseProxy* const a = cloth.getBroadphaseHandle();
  const btBroadphaseProxy* const b = object.getBroadphaseHandle();
  if (!a || !b || !cloth.checkCollideWith(&object) || !object.checkCollideWith(&cloth)) return false;
  const bool passes = (a->m_collisionFilterGroup & b->m_collisionFilterMask) != 0 &&
                      (b->m_collisionFilterGroup & a->m_collisionFilterMask) != 0;
  btOverlapFilterCallback* const filter =
      cloth.m_worldInfo->m_broadphase->getOverlappingPairCache()->getOverlapFilterCallback();
  return filter ? filter->needBroadphaseCollision(const_cast<btBroadphaseProxy*>(a), const_cast<btBroadphaseProxy*>(b))
                : passes;
}

void BodyWays::transferState(StateArchive& archive) {
  const auto transfer = [&archive](Body& body) {
    archive.object(body.object);
    archive.value(body.to);
  };
  archive.growing(m_before, transfer, [&archive](const Body& body) { return archive.has(body.object); });
  if (!archive.isRestoring()) return;
  for (Body& body : m_before) {
    const btBroadphaseProxy* const proxy = body.object ? body.object->getBroadphaseHandle() : nullptr;
    body.proxy = proxy ? proxy->m_uniqueId : -1;
  }
}

btTransform BodyWays::startOf(const btCollisionObject& object, int proxy, btScalar dt) const {
  const btTransform& to = object.getWorldTransform();
  const btVector3 velocity = object.getInterpolationLinearVelocity();
  const btVector3 turning = object.getInterpolationAngularVelocity();
  btTransform told;
  btTransformUtil::integrateTransform(to, -velocity, -turning, dt, told);
  if (object.isStaticObject()) told = to;
  const auto before = std::find_if(m_before.begin(), m_before.end(),
                                   [&](const Body& body) { return body.proxy == proxy && body.object == &object; });
  if (before == m_before.end()) return told;
  const btScalar untold = btRigidBody::upcast(&object) ? kUntoldSpeed : kUntoldSpeedOfLink;
  const bool isNear = (before->to.getOrigin() - told.getOrigin()).length() <= untold * dt;
  const bool isAlike = std::fabs(before->to.getRotation().angleShortestPath(told.getRotation())) <= kUntoldTurn * dt;
  return isNear && isAlike ? before->to : told;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
