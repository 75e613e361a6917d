// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

// The algorithms that Bullet keeps for each pair of objects whose boxes overlap, and of a compound shape for each part.

using PartAlgorithms = btAlignedObjectArray<btCollisionAlgorithm*>;

/// The part's algorithms. Null unless exactly one of the two shapes is compound: of two compound shapes Bullet keeps
/// them by pairs of parts, in another way.
PartAlgorithms* partsOf(btCollisionAlgorithm* algorithm);

const btCollisionObject& objectOf(const btBroadphaseProxy& proxy);
bool hasSoftBody(const btBroadphasePair& pair);

btCollisionObjectWrapper wrapped(const btCollisionObject& object);
/// A part of a compound shape, where it is. A wrapper refers to its frame.
struct WrappedPart {
  WrappedPart(const btCollisionObjectWrapper& compound, int part);
  WrappedPart(const WrappedPart&) = delete;
  WrappedPart& operator=(const WrappedPart&) = delete;

  const btTransform frame;
  const btCollisionObjectWrapper wrapper;
};

/// Makes the algorithm of the two, if it is not there.
btCollisionAlgorithm& ensure(btCollisionWorld& world, btCollisionAlgorithm*& algorithm,
                             const btCollisionObjectWrapper& first, const btCollisionObjectWrapper& second);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
