// SPDX-License-Identifier: Zlib
#pragma once

#include "tests/support/ClothScene.h"
#include "tests/support/ContactScene.h"

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace wetcloth_test {

/// Shapes as people have them. `compound` is one body made of four boxes that overlap, `mesh` a square of two
/// triangles, `fineMesh` one of 800, `heightfield` a level one.
enum class BodyShape { box, sphere, capsule, cylinder, cone, hull, compound, plane, mesh, fineMesh, heightfield };
enum class BodyMotion { stays, kinematic, dynamic };
/// What may happen to a body in mid-run.
enum class BodyEvent { none, moved, turned, scaled, swapped, removed };

inline constexpr BodyShape kBodyShapes[] = {BodyShape::box,      BodyShape::sphere,     BodyShape::capsule,
                                            BodyShape::cylinder, BodyShape::cone,       BodyShape::hull,
                                            BodyShape::compound, BodyShape::plane,      BodyShape::mesh,
                                            BodyShape::fineMesh, BodyShape::heightfield};
inline constexpr BodyMotion kBodyMotions[] = {BodyMotion::stays, BodyMotion::kinematic, BodyMotion::dynamic};
inline constexpr BodyEvent kBodyEvents[] = {BodyEvent::none,   BodyEvent::moved,   BodyEvent::turned,
                                            BodyEvent::scaled, BodyEvent::swapped, BodyEvent::removed};

inline const char* nameOf(BodyShape shape) {
  switch (shape) {
    case BodyShape::box: return "box";
    case BodyShape::sphere: return "sphere";
    case BodyShape::capsule: return "capsule";
    case BodyShape::cylinder: return "cylinder";
    case BodyShape::cone: return "cone";
    case BodyShape::hull: return "hull";
    case BodyShape::compound: return "compound";
    case BodyShape::plane: return "plane";
    case BodyShape::mesh: return "mesh";
    case BodyShape::fineMesh: return "fineMesh";
    case BodyShape::heightfield: break;
  }
  return "heightfield";
}

inline const char* nameOf(BodyMotion motion) {
  switch (motion) {
    case BodyMotion::stays: return "static";
    case BodyMotion::kinematic: return "kinematic";
    case BodyMotion::dynamic: break;
  }
  return "dynamic";
}

inline const char* nameOf(BodyEvent event) {
  switch (event) {
    case BodyEvent::none: return "at rest";
    case BodyEvent::moved: return "moved";
    case BodyEvent::turned: return "turned";
    case BodyEvent::scaled: return "scaled";
    case BodyEvent::swapped: return "swapped";
    case BodyEvent::removed: break;
  }
  return "removed";
}

/// Bullet's planes, meshes and heightfields do not move by themselves.
inline bool canBe(BodyShape shape, BodyMotion motion) {
  return motion != BodyMotion::dynamic || shape < BodyShape::plane;
}

/// A shape and what it is made of, which Bullet leaves to the application.
struct OwnedShape {
  std::vector<std::unique_ptr<btCollisionShape>> parts;
  std::unique_ptr<btTriangleMesh> mesh;
  std::vector<btScalar> heights;
  std::unique_ptr<btCollisionShape> shape;
  double top = 0;  ///< height of the surface that a cloth meets over the shape's origin [m]
};

/// Boxes side by side in one body, each 1 cm from the next, so that they overlap nearly in full; the top is level.
inline OwnedShape overlappingBoxes(int count) {
  OwnedShape made;
  auto compound = std::make_unique<btCompoundShape>();
  for (int i = 0; i < count; ++i) {
    made.parts.push_back(box(1, 0.5, 1));
    btTransform place;
    place.setIdentity();
    place.setOrigin(btVector3(btScalar(0.01 * i), 0, 0));
    compound->addChildShape(place, made.parts.back().get());
  }
  made.shape = std::move(compound);
  made.top = 0.5;
  return made;
}

/// A level square of 2 m x 2 m, cells x cells, two triangles each. A soft body meets them 10 cm away: Bullet extrudes
/// each by 6 cm, and gives it a margin of 4 cm.
inline OwnedShape meshSquare(int cells) {
  OwnedShape made;
  made.mesh = std::make_unique<btTriangleMesh>();
  const auto corner = [cells](int i, int k) {
    return btVector3(btScalar(-1 + 2.0 * i / cells), 0, btScalar(-1 + 2.0 * k / cells));
  };
  for (int i = 0; i < cells; ++i) {
    for (int k = 0; k < cells; ++k) {
      made.mesh->addTriangle(corner(i, k), corner(i, k + 1), corner(i + 1, k));
      made.mesh->addTriangle(corner(i + 1, k), corner(i, k + 1), corner(i + 1, k + 1));
    }
  }
  made.shape = std::make_unique<btBvhTriangleMeshShape>(made.mesh.get(), true);
  made.top = 0.1;
  return made;
}

inline OwnedShape levelHeightfield() {
  OwnedShape made;
  constexpr int kPoints = 11;
  made.heights.assign(kPoints * kPoints, btScalar(0));
  constexpr PHY_ScalarType kHeights = sizeof(btScalar) == sizeof(float) ? PHY_FLOAT : PHY_DOUBLE;
  made.shape = std::make_unique<btHeightfieldTerrainShape>(kPoints, kPoints, made.heights.data(), btScalar(1),
                                                           btScalar(-1), btScalar(1), 1, kHeights, false);
  made.shape->setLocalScaling(btVector3(btScalar(0.2), 1, btScalar(0.2)));
  made.top = 0.1;
  return made;
}

inline OwnedShape makeShape(BodyShape kind) {
  constexpr double kHullMargin = 0.04;
  OwnedShape made;
  made.top = 0.5;
  switch (kind) {
    case BodyShape::box: made.shape = box(1, 0.5, 1); break;
    case BodyShape::sphere: made.shape = std::make_unique<btSphereShape>(btScalar(0.5)); break;
    case BodyShape::capsule: made.shape = std::make_unique<btCapsuleShapeX>(btScalar(0.5), btScalar(1)); break;
    case BodyShape::cylinder: made.shape = std::make_unique<btCylinderShape>(btVector3(1, btScalar(0.5), 1)); break;
    case BodyShape::cone:
      made.shape = std::make_unique<btConeShape>(1, 1);
      made.top += kHullMargin;
      break;
    case BodyShape::hull: {
      auto hull = std::make_unique<btConvexHullShape>();
      for (int i = 0; i < 8; ++i) hull->addPoint(btVector3(i & 1 ? 1 : -1, i & 2 ? 0.5f : -0.5f, i & 4 ? 1 : -1));
      made.shape = std::move(hull);
      made.top += kHullMargin;
      break;
    }
    case BodyShape::compound: return overlappingBoxes(4);
    case BodyShape::plane:
      made.shape = std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0));
      made.top = 0.1;
      break;
    case BodyShape::mesh: return meshSquare(1);
    case BodyShape::fineMesh: return meshSquare(20);
    case BodyShape::heightfield: return levelHeightfield();
  }
  return made;
}

/// A body in a world, with its surface's top at the origin. A dynamic one floats: it has no gravity.
class Body {
 public:
  Body(BulletWorld& bullet, OwnedShape shape, BodyMotion motion = BodyMotion::stays)
      : m_bullet(bullet), m_shape(std::move(shape)) {
    const btScalar mass = motion == BodyMotion::dynamic ? 50 : 0;
    btVector3 inertia(0, 0, 0);
    if (mass > 0) m_shape.shape->calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, m_shape.shape.get(), inertia);
    info.m_startWorldTransform.setIdentity();
    info.m_startWorldTransform.setOrigin(btVector3(0, btScalar(-m_shape.top), 0));
    m_body = std::make_unique<btRigidBody>(info);
    m_body->setFlags(m_body->getFlags() | BT_DISABLE_WORLD_GRAVITY);
    m_body->setActivationState(DISABLE_DEACTIVATION);
    if (motion == BodyMotion::kinematic) {
      m_body->setCollisionFlags((m_body->getCollisionFlags() & ~btCollisionObject::CF_STATIC_OBJECT) |
                                btCollisionObject::CF_KINEMATIC_OBJECT);
    }
    m_bullet.world().addRigidBody(m_body.get());
  }
  Body(BulletWorld& bullet, BodyShape shape, BodyMotion motion = BodyMotion::stays)
      : Body(bullet, makeShape(shape), motion) {}
  ~Body() { remove(); }
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  bool isThere() const { return m_body != nullptr; }
  btRigidBody& body() { return *m_body; }

  /// Puts it elsewhere between two steps.
  void place(const btTransform& frame) {
    m_body->setWorldTransform(frame);
    m_body->setInterpolationWorldTransform(frame);
    m_bullet.world().updateSingleAabb(m_body.get());
  }
  void move(const btVector3& way) {
    btTransform frame = m_body->getWorldTransform();
    frame.getOrigin() += way;
    place(frame);
  }
  void turn(const btQuaternion& rotation) {
    btTransform frame = m_body->getWorldTransform();
    frame.setRotation(rotation * frame.getRotation());
    place(frame);
  }
  /// Times its size. Bullet's grid of distances has to be told.
  void scale(btScalar factor) {
    m_shape.shape->setLocalScaling(m_shape.shape->getLocalScaling() * factor);
    forgetPairs();
  }
  /// Another shape in the place of this one, which is deleted.
  void swap(OwnedShape shape) {
    m_body->setCollisionShape(shape.shape.get());
    std::swap(m_shape, shape);
    forgetDistances(shape);
    forgetPairs();
  }
  /// Takes it out of the world and deletes it.
  void remove() {
    if (!m_body) return;
    m_bullet.world().removeRigidBody(m_body.get());
    forgetDistances(m_shape);
    m_body.reset();
  }
  void undergo(BodyEvent event) {
    switch (event) {
      case BodyEvent::none: return;
      case BodyEvent::moved: return move(btVector3(0, -3, 0));
      case BodyEvent::turned: return turn(btQuaternion(btVector3(0, 0, 1), btScalar(1.2)));
      case BodyEvent::scaled: return scale(btScalar(0.25));
      case BodyEvent::swapped: {
        OwnedShape small;
        small.shape = box(0.05, 0.05, 0.05);
        return swap(std::move(small));
      }
      case BodyEvent::removed: remove();
    }
  }

 private:
  // Bullet tells shapes by their addresses, which may be used anew.
  void forgetDistances(const OwnedShape& shape) {
    m_bullet.info().m_sparsesdf.RemoveReferences(shape.shape.get());
    for (const auto& part : shape.parts) m_bullet.info().m_sparsesdf.RemoveReferences(part.get());
  }
  void forgetPairs() {
    forgetDistances(m_shape);
    btDispatcher* const dispatcher = m_bullet.world().getDispatcher();
    m_bullet.world().getPairCache()->cleanProxyFromPairs(m_body->getBroadphaseHandle(), dispatcher);
    m_bullet.world().updateSingleAabb(m_body.get());
  }

  BulletWorld& m_bullet;
  OwnedShape m_shape;
  std::unique_ptr<btRigidBody> m_body;
};

/// A cloth that lies on a body in a world of its own. With gravity upwards it hangs from it.
class OnBody {
 public:
  OnBody(WorldKind kind, OwnedShape shape, BodyMotion motion = BodyMotion::stays,
         const btVector3& gravity = kEarthGravity, Lying lying = Lying())
      : scene(kind, gravity, lying.builder(kind)), body(scene.bullet(), std::move(shape), motion) {
    scene.addBulletSpringsForStep();
  }
  OnBody(WorldKind kind, BodyShape shape, BodyMotion motion = BodyMotion::stays,
         const btVector3& gravity = kEarthGravity, Lying lying = Lying())
      : OnBody(kind, makeShape(shape), motion, gravity, lying) {}

  ClothScene scene;
  Body body;
};

}  // namespace wetcloth_test
