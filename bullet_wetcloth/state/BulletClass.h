// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCompoundCollisionAlgorithm.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletSoftBody/btSoftBodyConcaveCollisionAlgorithm.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

// Which of Bullet's own classes an object is. A Bullet that was built without RTTI has no types to ask for, so an
// object is compared with one that is made for that, by the table of virtual functions: what is derived from these
// classes is none of them. Null is none of them, too.

btDbvtBroadphase* asDbvtBroadphase(btBroadphaseInterface* broadphase);

/// It, or one of the solvers of Bullet that are derived from it and keep no more than it does from step to step.
btSequentialImpulseConstraintSolver* asSequentialImpulse(btConstraintSolver* solver);

/// One compound shape and another one that is not compound.
btCompoundCollisionAlgorithm* asCompound(btCollisionAlgorithm* algorithm);

/// A soft body and a plane, a mesh of triangles, or a heightfield.
btSoftBodyConcaveCollisionAlgorithm* asSoftConcave(btCollisionAlgorithm* algorithm);

/// Of those for soft bodies, one that remembers nothing: against a convex shape, another soft body, or an empty shape.
bool remembersNothing(btCollisionAlgorithm* algorithm);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
