// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <unordered_map>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Whose a manifold is, in numbers that mean the same in a world that was built anew.
struct ManifoldPlace {
  int first = 0;  ///< the pair's objects, as numbered in the world
  int second = 0;
  int part = -1;   ///< child of the compound shape, if one of the pair has one
  int number = 0;  ///< among the manifolds of the pair, or of the part
};

/// The manifolds that belong to overlapping pairs. Others are Bullet's predictions for fast bodies (ccd).
std::unordered_map<const btPersistentManifold*, ManifoldPlace> manifoldPlaces(btCollisionWorld& world);

/// The manifold at this place, which is made when it is not there; null when the pair is not there or has none such.
/// Making lets the pair, or the part, collide once: Bullet's contact callbacks are called as in a step.
btPersistentManifold* manifoldAt(btCollisionWorld& world, const ManifoldPlace& place);

/// Takes away the manifolds of all pairs, with the algorithms that own them.
void removeManifolds(btCollisionWorld& world);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
