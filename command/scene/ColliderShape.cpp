// SPDX-License-Identifier: Zlib
#include "command/scene/ColliderShape.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btTriangleMesh.h>

#include <cstddef>

namespace command {
namespace {

constexpr double planeHalfExtent = 50;
/// Bullet puts it round hulls and triangles; its own default is 4 cm.
constexpr double roundMargin = 0.001;

/// Filled where it stays: a copy would point to the numbers of the first one.
struct MeshStorage {
  MeshStorage(const TriangleMesh& mesh, const btVector3& middle) {
    const auto corner = [&](int i) -> btVector3 { return mesh.vertices[static_cast<std::size_t>(i)] - middle; };
    for (const auto& [a, b, c] : mesh.triangles) triangles.addTriangle(corner(a), corner(b), corner(c));
  }
  btTriangleMesh triangles;
};
/// A mesh and the numbers that Bullet only points to.
class OwnedMeshShape : private MeshStorage, public btBvhTriangleMeshShape {
 public:
  OwnedMeshShape(const TriangleMesh& mesh, const btVector3& middle)
      : MeshStorage(mesh, middle), btBvhTriangleMeshShape(&this->triangles, true) {}
};

/// Takes Bullet's axis y to a line.
btTransform along(const btVector3& from, const btVector3& to) {
  return btTransform(shortestArcQuat(btVector3(0, 1, 0), (to - from).normalized()), (from + to) / 2);
}

btTransform at(const btVector3& place) { return btTransform(btQuaternion::getIdentity(), place); }

struct MakeShape {
  const btVector3 middle;

  ColliderShape operator()(const Plane& plane) const {
    const btScalar half = btScalar(planeHalfExtent);
    return {
        std::make_unique<btBoxShape>(btVector3(half, half, half)),
        btTransform(shortestArcQuat(btVector3(0, 1, 0), plane.normal), plane.normal * (btScalar(plane.offset) - half))};
  }
  ColliderShape operator()(const Box& box) const {
    return {std::make_unique<btBoxShape>(box.halfExtents), at(box.centre)};
  }
  ColliderShape operator()(const Sphere& sphere) const {
    return {std::make_unique<btSphereShape>(btScalar(sphere.radius)), at(sphere.centre)};
  }
  ColliderShape operator()(const Capsule& capsule) const {
    const btScalar length = (capsule.to - capsule.from).length();
    return {std::make_unique<btCapsuleShape>(btScalar(capsule.radius), length), along(capsule.from, capsule.to)};
  }
  ColliderShape operator()(const Cylinder& cylinder) const {
    const btScalar radius = btScalar(cylinder.radius);
    const btVector3 half(radius, (cylinder.to - cylinder.from).length() / 2, radius);
    return {std::make_unique<btCylinderShape>(half), along(cylinder.from, cylinder.to)};
  }
  ColliderShape operator()(const Hull& hull) const {
    auto shape = std::make_unique<btConvexHullShape>();
    for (const btVector3& point : hull.points) shape->addPoint(point - middle, false);
    shape->recalcLocalAabb();
    shape->setMargin(btScalar(roundMargin));
    return {std::move(shape), at(middle)};
  }
  ColliderShape operator()(const TriangleMesh& mesh) const {
    auto shape = std::make_unique<OwnedMeshShape>(mesh, middle);
    shape->setMargin(btScalar(roundMargin));
    return {std::move(shape), at(middle)};
  }
};

}  // namespace

ColliderShape shapeOf(const Collider& collider) { return std::visit(MakeShape{middleOf(collider)}, collider.shape); }

}  // namespace command
