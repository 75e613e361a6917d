// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/state/ManifoldPlace.h"

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btCompoundCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCompoundCompoundCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

const btCollisionObject& objectOf(const btBroadphaseProxy& proxy) {
  return *static_cast<const btCollisionObject*>(proxy.m_clientObject);
}

btManifoldArray manifoldsOf(btCollisionAlgorithm* algorithm) {
  btManifoldArray manifolds;
  if (algorithm) algorithm->getAllContactManifolds(manifolds);
  return manifolds;
}

/// What Bullet keeps for each part of a compound shape, protected and without accessors for all of it.
/// Of two compound shapes it keeps them by pairs of parts, in another way.
class Parts : btCompoundCollisionAlgorithm {
 public:
  using Algorithms = btAlignedObjectArray<btCollisionAlgorithm*>;

  /// Null unless exactly one of the two shapes is compound.
  static Algorithms* of(btCollisionAlgorithm* algorithm) {
    auto* const compound = dynamic_cast<btCompoundCollisionAlgorithm*>(algorithm);
    if (!compound || dynamic_cast<btCompoundCompoundCollisionAlgorithm*>(compound)) return nullptr;
    return &(compound->*(&Parts::m_childCollisionAlgorithms));
  }
};

btCollisionObjectWrapper wrapped(const btCollisionObject& object) {
  return {nullptr, object.getCollisionShape(), &object, object.getWorldTransform(), -1, -1};
}

void collide(btCollisionWorld& world, btCollisionAlgorithm*& algorithm, const btCollisionObjectWrapper& first,
             const btCollisionObjectWrapper& second) {
  if (!algorithm) {
    algorithm = world.getDispatcher()->findAlgorithm(&first, &second, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  }
  btManifoldResult result(&first, &second);
  algorithm->processCollision(&first, &second, world.getDispatchInfo(), &result);
}

// As btCompoundCollisionAlgorithm does it: the part comes first.
void collidePart(btCollisionWorld& world, btCollisionAlgorithm*& algorithm, int part,
                 const btCollisionObjectWrapper& compound, const btCollisionObjectWrapper& other) {
  const auto& shape = static_cast<const btCompoundShape&>(*compound.getCollisionShape());
  const btTransform frame = compound.getWorldTransform() * shape.getChildTransform(part);
  const btCollisionObjectWrapper child(&compound, shape.getChildShape(part), compound.getCollisionObject(), frame, -1,
                                       part);
  collide(world, algorithm, child, other);
}

btPersistentManifold* manifoldOfPart(btCollisionWorld& world, Parts::Algorithms& parts, const ManifoldPlace& place,
                                     const btCollisionObjectWrapper& first, const btCollisionObjectWrapper& second) {
  if (place.part < 0 || place.part >= parts.size()) return nullptr;
  btCollisionAlgorithm*& algorithm = parts[place.part];
  if (manifoldsOf(algorithm).size() == 0) {
    const bool isFirst = first.getCollisionShape()->isCompound();
    collidePart(world, algorithm, place.part, isFirst ? first : second, isFirst ? second : first);
  }
  const btManifoldArray manifolds = manifoldsOf(algorithm);
  return place.number < manifolds.size() ? manifolds[place.number] : nullptr;
}

}  // namespace

std::unordered_map<const btPersistentManifold*, ManifoldPlace> manifoldPlaces(btCollisionWorld& world) {
  std::unordered_map<const btPersistentManifold*, ManifoldPlace> places;
  const btBroadphasePairArray& pairs = world.getPairCache()->getOverlappingPairArray();
  for (int i = 0; i < pairs.size(); ++i) {
    ManifoldPlace place{objectOf(*pairs[i].m_pProxy0).getWorldArrayIndex(),
                        objectOf(*pairs[i].m_pProxy1).getWorldArrayIndex(), -1, 0};
    const auto number = [&](btCollisionAlgorithm* algorithm) {
      const btManifoldArray manifolds = manifoldsOf(algorithm);
      for (place.number = 0; place.number < manifolds.size(); ++place.number) places[manifolds[place.number]] = place;
    };
    const Parts::Algorithms* const parts = Parts::of(pairs[i].m_algorithm);
    if (!parts) number(pairs[i].m_algorithm);
    for (place.part = 0; parts && place.part < parts->size(); ++place.part) number((*parts)[place.part]);
  }
  return places;
}

btPersistentManifold* manifoldAt(btCollisionWorld& world, const ManifoldPlace& place) {
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  btBroadphasePair* const pair = world.getPairCache()->findPair(objects[place.first]->getBroadphaseHandle(),
                                                                objects[place.second]->getBroadphaseHandle());
  if (!pair) return nullptr;
  const btCollisionObjectWrapper first = wrapped(objectOf(*pair->m_pProxy0));
  const btCollisionObjectWrapper second = wrapped(objectOf(*pair->m_pProxy1));
  if (!pair->m_algorithm) {
    pair->m_algorithm = world.getDispatcher()->findAlgorithm(&first, &second, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  }
  if (Parts::Algorithms* const parts = Parts::of(pair->m_algorithm)) {
    return manifoldOfPart(world, *parts, place, first, second);
  }
  if (manifoldsOf(pair->m_algorithm).size() == 0) collide(world, pair->m_algorithm, first, second);
  const btManifoldArray manifolds = manifoldsOf(pair->m_algorithm);
  return place.number < manifolds.size() ? manifolds[place.number] : nullptr;
}

void removeManifolds(btCollisionWorld& world) {
  btOverlappingPairCache& cache = *world.getPairCache();
  for (int i = 0; i < cache.getNumOverlappingPairs(); ++i) {
    btBroadphasePair& pair = cache.getOverlappingPairArrayPtr()[i];
    if (manifoldsOf(pair.m_algorithm).size() > 0) cache.cleanOverlappingPair(pair, world.getDispatcher());
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
