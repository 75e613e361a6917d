// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/state/PairAlgorithms.h"

#include "bullet_wetcloth/state/BulletClass.h"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Protected and without accessors; a pointer to member named through a derived class may reach them.
struct Parts : btCompoundCollisionAlgorithm {
  static PartAlgorithms& of(btCompoundCollisionAlgorithm& algorithm) {
    return algorithm.*(&Parts::m_childCollisionAlgorithms);
  }
};

const btCompoundShape& compoundOf(const btCollisionObjectWrapper& wrapper) {
  return static_cast<const btCompoundShape&>(*wrapper.getCollisionShape());
}

bool isSoft(const btBroadphaseProxy& proxy) {
  return objectOf(proxy).getInternalType() == btCollisionObject::CO_SOFT_BODY;
}

}  // namespace

PartAlgorithms* partsOf(btCollisionAlgorithm* algorithm) {
  btCompoundCollisionAlgorithm* const compound = asCompound(algorithm);
  return compound ? &Parts::of(*compound) : nullptr;
}

const btCollisionObject& objectOf(const btBroadphaseProxy& proxy) {
  return *static_cast<const btCollisionObject*>(proxy.m_clientObject);
}

bool hasSoftBody(const btBroadphasePair& pair) { return isSoft(*pair.m_pProxy0) || isSoft(*pair.m_pProxy1); }

btCollisionObjectWrapper wrapped(const btCollisionObject& object) {
  return {nullptr, object.getCollisionShape(), &object, object.getWorldTransform(), -1, -1};
}

WrappedPart::WrappedPart(const btCollisionObjectWrapper& compound, int part)
    : frame(compound.getWorldTransform() * compoundOf(compound).getChildTransform(part)),
      wrapper(&compound, compoundOf(compound).getChildShape(part), compound.getCollisionObject(), frame, -1, part) {}

btCollisionAlgorithm& ensure(btCollisionWorld& world, btCollisionAlgorithm*& algorithm,
                             const btCollisionObjectWrapper& first, const btCollisionObjectWrapper& second) {
  if (!algorithm) {
    algorithm = world.getDispatcher()->findAlgorithm(&first, &second, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  }
  return *algorithm;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
