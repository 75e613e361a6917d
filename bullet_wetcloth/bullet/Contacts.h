// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletSoftBody/btSoftBody.h>

#include <array>
#include <cstddef>
#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A node, or a point of a triangle, by the weights of its nodes: each >= 0, their sum 1.
struct ContactPoint {
  int count = 1;  ///< 1: a node; 3: a triangle
  std::array<int, 3> nodes = {0, 0, 0};
  std::array<double, 3> weights = {1, 0, 0};
};

/// How far what a sleeping cloth touches may move while the cloth sleeps on [m].
constexpr btScalar kContactMotionTolerance = btScalar(1e-3);

/// A contact of a cloth with a rigid body, as Bullet lists it.
struct RigidContact {
  ContactPoint point;
  int face = -1;                                  ///< the triangle's number, -1 when the point is a node
  btCollisionObject* object = nullptr;            ///< is in the world
  btVector3 normal = btVector3(0, 0, 0);          ///< out of the object, of length 1
  double gap = 0;                                 ///< distance to where the contact holds the cloth [m]; < 0: inside
  btSoftBody::RContact* positionBased = nullptr;  ///< Bullet's own entry; null in the deformable world
  btSoftBody::DeformableRigidContact* deformable = nullptr;  ///< the same there; null in the other worlds
};

/// A contact of a node of one soft body with a triangle of another, as Bullet lists it.
struct FaceContact {
  int node = 0;
  int face = 0;
  ContactPoint point;                             ///< on the triangle
  btVector3 normal = btVector3(0, 0, 0);          ///< towards the node, of length 1
  btSoftBody::SContact* positionBased = nullptr;  ///< Bullet's own entry; null in the deformable world
};

/// Which contacts Bullet lists depends on the kind of world and on the body's m_cfg.collisions. These three say why a
/// list is not kept, in words for an error message; they are empty when it is kept.
/// Of contacts with rigid bodies:
std::string whyNoRigidContacts(const btSoftBody& body, bool deformable);
/// Of contacts of single nodes with rigid bodies; the deformable world may list those of triangles only:
std::string whyNoNodeContacts(const btSoftBody& body, bool deformable);
/// Of contacts with other soft bodies:
std::string whyNoFaceContacts(const btSoftBody& body, bool deformable);

/// Finds out whether an object is still in the world. A contact of the last substep may name one that has been deleted
/// since, so only addresses are compared.
class WorldObjects {
 public:
  explicit WorldObjects(const btCollisionWorld& world) : m_world(world) {}
  /// The object at this address, or null when it is not in the world.
  btCollisionObject* find(const btCollisionObject* object);

 private:
  const btCollisionWorld& m_world;
  const btCollisionObject* m_last = nullptr;  // contacts with one object follow each other
  btCollisionObject* m_found = nullptr;
};

/// A soft body's contacts with rigid bodies. In the stage `contact` they are those of this substep, in earlier stages
/// those of the last one. Left out are contacts of a node that is no longer in the body, and with an object that has
/// left the world.
class RigidContacts {
 public:
  RigidContacts(btSoftBody& body, const btCollisionWorld& world, bool deformable)
      : m_body(body), m_deformable(deformable), m_objects(world) {}

  /// Calls visit(const RigidContact&) for each.
  template <class Visit>
  void visit(Visit visitor) {
    RigidContact contact;
    const int count = size();
    for (int i = 0; i < count; ++i) {
      if (read(i, contact)) visitor(static_cast<const RigidContact&>(contact));
    }
  }

 private:
  int size() const;
  bool read(int i, RigidContact& contact);

  btSoftBody& m_body;
  bool m_deformable;
  WorldObjects m_objects;
};

/// Contacts of the nodes of one soft body with the triangles of another one of the same world. In the stage `contact`
/// of a position-based world they are those of this substep, otherwise those of the last one. Left out are contacts of
/// a node or a triangle that is no longer there.
class FaceContacts {
 public:
  FaceContacts(btSoftBody& nodesOf, btSoftBody& facesOf, bool deformable)
      : m_nodesOf(nodesOf), m_facesOf(facesOf), m_deformable(deformable) {}

  /// Calls visit(const FaceContact&) for each.
  template <class Visit>
  void visit(Visit visitor) {
    FaceContact contact;
    const int count = size();
    for (int i = 0; i < count; ++i) {
      if (read(i, contact)) visitor(static_cast<const FaceContact&>(contact));
    }
  }
  /// How many contacts Bullet lists for the nodes' body, those with other bodies' triangles included.
  int size() const;

 private:
  bool read(int i, FaceContact& contact);

  btSoftBody& m_nodesOf;
  btSoftBody& m_facesOf;
  bool m_deformable;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
