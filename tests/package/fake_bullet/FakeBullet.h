// SPDX-License-Identifier: Zlib
// What FindBulletSoftBody's program uses of Bullet. One function of each library has the scalar in its mangled name.
#pragma once

#ifdef BT_USE_DOUBLE_PRECISION
using btScalar = double;
#else
using btScalar = float;
#endif

struct btVector3 {};

template <class T>
struct btAlignedObjectArray {};

struct btGeometryUtil {
  static bool isPointInsidePlanes(const btAlignedObjectArray<btVector3>&, const btVector3&, btScalar);
};

class btQuantizedBvh {
 public:
  btQuantizedBvh();

 protected:
  int m_bulletVersion;
};

struct btCollisionShape {
  btScalar getContactBreakingThreshold(btScalar) const;
};

struct btSphereShape : btCollisionShape {
  explicit btSphereShape(btScalar) {}
};

struct btSoftBodyRigidBodyCollisionConfiguration {};

struct btCollisionDispatcher {
  explicit btCollisionDispatcher(btSoftBodyRigidBodyCollisionConfiguration*) {}
};

struct btDbvtBroadphase {};

struct btSequentialImpulseConstraintSolver {};

struct btDiscreteDynamicsWorld {
  int stepSimulation(btScalar);
};

struct btSoftBodyWorldInfo {};

struct btSoftRigidDynamicsWorld : btDiscreteDynamicsWorld {
  template <class... T>
  explicit btSoftRigidDynamicsWorld(T*...) {}
  btSoftBodyWorldInfo& getWorldInfo() { return info; }
  btSoftBodyWorldInfo info;
};

struct btSoftBody {
  explicit btSoftBody(btSoftBodyWorldInfo*) {}
  void setTotalMass(btScalar, bool);
};
