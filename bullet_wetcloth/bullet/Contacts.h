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

class WetCloth;

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
  int face = -1;                                  ///< of the triangle, when the point is on one
  btCollisionObject* object = nullptr;            ///< is in the world
  btVector3 normal = btVector3(0, 0, 0);          ///< out of the object, of length 1
  double gap = 0;                                 ///< to where the contact holds the cloth [m]; < 0: inside
  btSoftBody::RContact* positionBased = nullptr;  ///< Bullet's own entry: one of these two
  btSoftBody::DeformableRigidContact* deformable = nullptr;
};

/// A contact of a node of one soft body with a triangle of another, as Bullet lists it.
struct FaceContact {
  int node = 0;
  int face = 0;
  ContactPoint point;                             ///< on the triangle
  btVector3 normal = btVector3(0, 0, 0);          ///< towards the node, of length 1
  btSoftBody::SContact* positionBased = nullptr;  ///< Bullet's own entry; null in the deformable world
};

/// Why Bullet keeps no list of this cloth's contacts with rigid bodies, in its world and with its collision flags;
/// empty when it does.
std::string whyNoRigidContacts(const WetCloth& cloth);
/// The same of contacts of its nodes, one by one: a body of the deformable world may have triangles' contacts only.
std::string whyNoNodeContacts(const WetCloth& cloth);
/// The same of its contacts with other soft bodies.
std::string whyNoFaceContacts(const WetCloth& cloth);

/// The area by which a node touches [m^2], > 0: a third of its triangles at rest; for a node of no triangle its dry
/// mass over the fabric's areal density. Builds the cloth's RestMesh when first asked for.
double contactArea(WetCloth& cloth, std::size_t node);

/// Finds objects of a world by their address alone: what a list of the last substep names may have been deleted since.
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

/// A cloth's contacts with rigid bodies. In the stage `contact` they are those of this substep, before that those of
/// the last one; entries whose node is no longer in the body, or whose object has left the world, are passed over.
class RigidContacts {
 public:
  explicit RigidContacts(WetCloth& cloth);

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

/// Contacts of the nodes of one soft body with the triangles of another one of the same world. In the position-based
/// worlds, at the stage `contact`, they are those of this substep; otherwise those of the last one. Entries whose node
/// or triangle is no longer there are passed over.
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
  /// Of all entries in the list, also those with other bodies.
  int size() const;

 private:
  bool read(int i, FaceContact& contact);

  btSoftBody& m_nodesOf;
  btSoftBody& m_facesOf;
  bool m_deformable;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
