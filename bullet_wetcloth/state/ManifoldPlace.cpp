// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/state/ManifoldPlace.h"

#include "bullet_wetcloth/state/PairAlgorithms.h"

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Not of a soft body's algorithms: btSoftSoftCollisionAlgorithm answers from what it never set.
btManifoldArray manifoldsOf(btCollisionAlgorithm* algorithm) {
  btManifoldArray manifolds;
  if (algorithm) algorithm->getAllContactManifolds(manifolds);
  return manifolds;
}

void collide(btCollisionWorld& world, btCollisionAlgorithm*& algorithm, const btCollisionObjectWrapper& first,
             const btCollisionObjectWrapper& second) {
  btManifoldResult result(&first, &second);
  ensure(world, algorithm, first, second).processCollision(&first, &second, world.getDispatchInfo(), &result);
}

btPersistentManifold* manifoldOfPart(btCollisionWorld& world, PartAlgorithms& parts, const ManifoldPlace& place,
                                     const btCollisionObjectWrapper& first, const btCollisionObjectWrapper& second) {
  if (place.part < 0 || place.part >= parts.size()) return nullptr;
  btCollisionAlgorithm*& algorithm = parts[place.part];
  if (manifoldsOf(algorithm).size() == 0) {
    // As btCompoundCollisionAlgorithm does it: the part comes first.
    const bool isFirst = first.getCollisionShape()->isCompound();
    const WrappedPart part(isFirst ? first : second, place.part);
    collide(world, algorithm, part.wrapper, isFirst ? second : first);
  }
  const btManifoldArray manifolds = manifoldsOf(algorithm);
  return place.number < manifolds.size() ? manifolds[place.number] : nullptr;
}

}  // namespace

std::unordered_map<const btPersistentManifold*, ManifoldPlace> manifoldPlaces(btCollisionWorld& world) {
  std::unordered_map<const btPersistentManifold*, ManifoldPlace> places;
  const btBroadphasePairArray& pairs = world.getPairCache()->getOverlappingPairArray();
  for (int i = 0; i < pairs.size(); ++i) {
    if (hasSoftBody(pairs[i])) continue;
    ManifoldPlace place{objectOf(*pairs[i].m_pProxy0).getWorldArrayIndex(),
                        objectOf(*pairs[i].m_pProxy1).getWorldArrayIndex(), -1, 0};
    const auto number = [&](btCollisionAlgorithm* algorithm) {
      const btManifoldArray manifolds = manifoldsOf(algorithm);
      for (place.number = 0; place.number < manifolds.size(); ++place.number) places[manifolds[place.number]] = place;
    };
    const PartAlgorithms* const parts = partsOf(pairs[i].m_algorithm);
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
  if (PartAlgorithms* const parts = partsOf(&ensure(world, pair->m_algorithm, first, second))) {
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
    if (!hasSoftBody(pair) && manifoldsOf(pair.m_algorithm).size() > 0)
      cache.cleanOverlappingPair(pair, world.getDispatcher());
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
