// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/state/BulletClass.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btEmptyCollisionAlgorithm.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletDynamics/ConstraintSolver/btNNCGConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btSoftRigidCollisionAlgorithm.h>
#include <BulletSoftBody/btSoftSoftCollisionAlgorithm.h>

#include <cstring>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// All compilers that Bullet is built with keep it at the beginning of such an object.
template <class Polymorphic>
const void* tableOf(const Polymorphic& object) {
  const void* table = nullptr;
  std::memcpy(&table, static_cast<const void*>(&object), sizeof table);
  return table;
}

template <class Class, class Base, class... Arguments>
bool isExactly(const Base* object, Arguments&&... arguments) {
  static const void* const table = tableOf(Class(arguments...));
  return object && tableOf(*object) == table;
}

const btCollisionAlgorithmConstructionInfo kNoWorld;

// Of no object.
btCollisionObjectWrapper nobody(const btCollisionShape* shape) {
  return {nullptr, shape, nullptr, btTransform::getIdentity(), -1, -1};
}

}  // namespace

btDbvtBroadphase* asDbvtBroadphase(btBroadphaseInterface* broadphase) {
  return isExactly<btDbvtBroadphase>(broadphase) ? static_cast<btDbvtBroadphase*>(broadphase) : nullptr;
}

btSequentialImpulseConstraintSolver* asSequentialImpulse(btConstraintSolver* solver) {
  const bool isOne =
      isExactly<btSequentialImpulseConstraintSolver>(solver) || isExactly<btMultiBodyConstraintSolver>(solver) ||
      isExactly<btDeformableMultiBodyConstraintSolver>(solver) || isExactly<btNNCGConstraintSolver>(solver);
  return isOne ? static_cast<btSequentialImpulseConstraintSolver*>(solver) : nullptr;
}

btCompoundCollisionAlgorithm* asCompound(btCollisionAlgorithm* algorithm) {
  static const void* const table = [] {
    const btCompoundShape empty;
    const btCollisionObjectWrapper compound = nobody(&empty);
    const btCollisionObjectWrapper nothing = nobody(nullptr);
    return tableOf(btCompoundCollisionAlgorithm(kNoWorld, &compound, &nothing, false));
  }();
  return algorithm && tableOf(*algorithm) == table ? static_cast<btCompoundCollisionAlgorithm*>(algorithm) : nullptr;
}

btSoftBodyConcaveCollisionAlgorithm* asSoftConcave(btCollisionAlgorithm* algorithm) {
  const btCollisionObjectWrapper nothing = nobody(nullptr);
  const bool isOne = isExactly<btSoftBodyConcaveCollisionAlgorithm>(algorithm, kNoWorld, &nothing, &nothing, false);
  return isOne ? static_cast<btSoftBodyConcaveCollisionAlgorithm*>(algorithm) : nullptr;
}

bool remembersNothing(btCollisionAlgorithm* algorithm) {
  btPersistentManifold* const noManifold = nullptr;
  const btCollisionObjectWrapper* const noPair = nullptr;
  return isExactly<btSoftRigidCollisionAlgorithm>(algorithm, noManifold, kNoWorld, noPair, noPair, false) ||
         isExactly<btSoftSoftCollisionAlgorithm>(algorithm, kNoWorld) ||
         isExactly<btEmptyAlgorithm>(algorithm, kNoWorld);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
