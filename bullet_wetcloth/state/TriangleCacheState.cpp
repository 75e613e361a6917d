// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/state/TriangleCacheState.h"

#include "bullet_wetcloth/state/BulletClass.h"
#include "bullet_wetcloth/state/PairAlgorithms.h"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletSoftBody/btSoftBody.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

using TriangleMap = btHashMap<btHashKey<btTriIndex>, btTriIndex>;

// Private and without accessors: only an explicit instantiation may name them.
struct CallbackMember {
  using Type = btSoftBodyTriangleCallback btSoftBodyConcaveCollisionAlgorithm::*;
  friend Type member(CallbackMember);
};
struct CacheMember {
  using Type = TriangleMap btSoftBodyTriangleCallback::*;
  friend Type member(CacheMember);
};
template <class Named, typename Named::Type Member>
struct Naming {
  friend typename Named::Type member(Named) { return Member; }
};
template struct Naming<CallbackMember, &btSoftBodyConcaveCollisionAlgorithm::m_btSoftBodyTriangleCallback>;
template struct Naming<CacheMember, &btSoftBodyTriangleCallback::m_shapeCache>;

TriangleMap& cacheOf(btSoftBodyConcaveCollisionAlgorithm& algorithm) {
  return (algorithm.*member(CallbackMember())).*member(CacheMember());
}

// A triangle with some thickness.
struct Prism {
  static constexpr int kCorners = 6;
  int triangle = 0;  // as Bullet numbers it
  btVector3 corners[kCorners];
};

struct TriangleCache {
  int first = 0;  // the pair's objects, as numbered in the world
  int second = 0;
  std::vector<int> parts;  // the way through compound shapes
  std::vector<Prism> prisms;
};

std::vector<Prism> prismsOf(StateArchive& archive, const TriangleMap& cache) {
  std::vector<Prism> prisms(static_cast<std::size_t>(cache.size()));
  for (int i = 0; i < cache.size(); ++i) {
    Prism& prism = prisms[static_cast<std::size_t>(i)];
    const btTriIndex& entry = *cache.getAtIndex(i);
    prism.triangle = entry.getUid();
    const auto& hull = static_cast<const btConvexHullShape&>(*entry.m_childShape);
    if (hull.getNumPoints() != Prism::kCorners) archive.fail("Bullet's cache of triangles is not as it is known");
    std::copy_n(hull.getUnscaledPoints(), Prism::kCorners, prism.corners);
  }
  return prisms;
}

/// Calls visit(algorithm, parts) for each algorithm of a soft body that is not one for a compound shape.
template <class Visit>
void forEachAlgorithm(btCollisionAlgorithm* algorithm, std::vector<int>& parts, const Visit& visit) {
  PartAlgorithms* const children = partsOf(algorithm);
  if (!children) {
    if (algorithm) visit(*algorithm, parts);
    return;
  }
  for (int part = 0; part < children->size(); ++part) {
    parts.push_back(part);
    forEachAlgorithm((*children)[part], parts, visit);
    parts.pop_back();
  }
}

/// Calls visit(pair, algorithm, parts) for those of all soft bodies.
template <class Visit>
void forEachSoftAlgorithm(btCollisionWorld& world, const Visit& visit) {
  btBroadphasePairArray& pairs = world.getPairCache()->getOverlappingPairArray();
  std::vector<int> parts;
  for (int i = 0; i < pairs.size(); ++i) {
    if (!hasSoftBody(pairs[i])) continue;
    forEachAlgorithm(pairs[i].m_algorithm, parts, [&](btCollisionAlgorithm& algorithm, const std::vector<int>& way) {
      visit(pairs[i], algorithm, way);
    });
  }
}

std::vector<TriangleCache> cachesOf(StateArchive& archive, btCollisionWorld& world) {
  std::vector<TriangleCache> caches;
  forEachSoftAlgorithm(world, [&](const btBroadphasePair& pair, btCollisionAlgorithm& algorithm,
                                  const std::vector<int>& parts) {
    btSoftBodyConcaveCollisionAlgorithm* const concave = asSoftConcave(&algorithm);
    if (!concave && !remembersNothing(&algorithm)) {
      archive.fail("a soft body collides by an algorithm that is not one of Bullet's for it, whose state is not saved");
    }
    if (!concave || cacheOf(*concave).size() == 0) return;
    caches.push_back({objectOf(*pair.m_pProxy0).getWorldArrayIndex(), objectOf(*pair.m_pProxy1).getWorldArrayIndex(),
                      parts, prismsOf(archive, cacheOf(*concave))});
  });
  return caches;
}

void transferPrisms(StateArchive& archive, std::vector<Prism>& prisms) {
  std::vector<int> triangles;
  prisms.resize(archive.count(prisms.size()));
  for (Prism& prism : prisms) {
    archive.local(prism.triangle);
    for (btVector3& corner : prism.corners) archive.local(corner);
    triangles.push_back(prism.triangle);
  }
  std::sort(triangles.begin(), triangles.end());
  if (std::adjacent_find(triangles.begin(), triangles.end()) != triangles.end()) {
    archive.fail("a triangle is in the cache twice");
  }
}

// One of the two is a soft body; the other's shape leads through compound shapes to one that is not convex.
void transferPlace(StateArchive& archive, TriangleCache& cache, const btCollisionObjectArray& objects) {
  cache.first = archive.place(cache.first, objects.size(), "object of a cached triangle");
  cache.second = archive.place(cache.second, objects.size(), "object of a cached triangle");
  const bool isFirstSoft = btSoftBody::upcast(objects[cache.first]) != nullptr;
  if (isFirstSoft == (btSoftBody::upcast(objects[cache.second]) != nullptr)) {
    archive.fail("a cached triangle is not of a soft body and another object");
  }
  const btCollisionShape* shape = objects[isFirstSoft ? cache.second : cache.first]->getCollisionShape();
  cache.parts.resize(archive.count(cache.parts.size()));
  for (int& part : cache.parts) {
    const auto* const compound = shape->isCompound() ? static_cast<const btCompoundShape*>(shape) : nullptr;
    part = archive.place(part, compound ? compound->getNumChildShapes() : 0, "part of a compound shape");
    shape = compound ? compound->getChildShape(part) : shape;
  }
  if (!shape->isConcave()) archive.fail("a cached triangle is of a shape that has none");
}

bool areTwoOfOneShape(const std::vector<TriangleCache>& caches) {
  std::vector<std::vector<int>> places;
  for (const TriangleCache& cache : caches) {
    places.push_back({std::min(cache.first, cache.second), std::max(cache.first, cache.second)});
    places.back().insert(places.back().end(), cache.parts.begin(), cache.parts.end());
  }
  std::sort(places.begin(), places.end());
  return std::adjacent_find(places.begin(), places.end()) != places.end();
}

/// The algorithm at the end of the way, each on it made when it is not there.
btCollisionAlgorithm& algorithmAt(btCollisionWorld& world, btCollisionAlgorithm*& algorithm,
                                  const std::vector<int>& way, std::size_t done, const btCollisionObjectWrapper& first,
                                  const btCollisionObjectWrapper& second) {
  btCollisionAlgorithm& found = ensure(world, algorithm, first, second);
  PartAlgorithms* const children = partsOf(&found);
  if (done == way.size() || !children || way[done] >= children->size()) return found;
  const bool isFirst = first.getCollisionShape()->isCompound();
  const WrappedPart part(isFirst ? first : second, way[done]);
  return algorithmAt(world, (*children)[way[done]], way, done + 1, part.wrapper, isFirst ? second : first);
}

void restore(btCollisionWorld& world, const TriangleCache& cache) {
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  btBroadphasePair* const pair = world.getPairCache()->findPair(objects[cache.first]->getBroadphaseHandle(),
                                                                objects[cache.second]->getBroadphaseHandle());
  if (!pair) return;
  btCollisionAlgorithm& algorithm =
      algorithmAt(world, pair->m_algorithm, cache.parts, 0, wrapped(objectOf(*pair->m_pProxy0)),
                  wrapped(objectOf(*pair->m_pProxy1)));
  btSoftBodyConcaveCollisionAlgorithm* const concave = asSoftConcave(&algorithm);
  if (!concave) return;
  for (const Prism& prism : cache.prisms) {
    btTriIndex entry(0, prism.triangle, new btConvexHullShape(prism.corners[0], Prism::kCorners));
    cacheOf(*concave).insert(btHashKey<btTriIndex>(entry.getUid()), entry);
  }
}

}  // namespace

void transferTriangleCaches(StateArchive& archive, btCollisionWorld& world) {
  std::vector<TriangleCache> caches;
  if (archive.isSaving()) caches = cachesOf(archive, world);
  caches.resize(archive.count(caches.size()));
  for (TriangleCache& cache : caches) {
    transferPlace(archive, cache, world.getCollisionObjectArray());
    transferPrisms(archive, cache.prisms);
  }
  if (areTwoOfOneShape(caches)) archive.fail("two caches of triangles are of one shape");
  if (!archive.isRestoring()) return;
  forEachSoftAlgorithm(world, [](const btBroadphasePair&, btCollisionAlgorithm& algorithm, const std::vector<int>&) {
    if (btSoftBodyConcaveCollisionAlgorithm* const concave = asSoftConcave(&algorithm)) concave->clearCache();
  });
  for (const TriangleCache& cache : caches) restore(world, cache);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
