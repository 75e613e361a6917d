// SPDX-License-Identifier: Zlib
#include "command/scene/ColliderReader.h"

#include "command/scene/Farthest.h"
#include "command/scene/ReadMesh.h"
#include "command/scene/ReadParameters.h"

#include <LinearMath/btQuaternion.h>

#include <string>
#include <vector>

namespace command {
namespace {

Plane readPlane(JsonCursor cursor) {
  cursor.expectObject(keys::plane);
  Plane plane{btVector3(0, 1, 0), 0};
  if (const auto normal = cursor.find("normal")) plane.normal = readDirection(*normal).normalized();
  readNumber(cursor, "offset_m", Range::finite(), plane.offset);
  return plane;
}

/// A capsule or a cylinder.
template <class Kind>
Kind readLong(JsonCursor cursor, const KeyTable& keys) {
  cursor.expectObject(keys);
  const Kind kind{readVector(cursor.at("from_m")), readVector(cursor.at("to_m")),
                  cursor.at("radius_m").number(Range::positive())};
  const btScalar longest =
      kind.from.absolute()[kind.from.absolute().maxAxis()] + kind.to.absolute()[kind.to.absolute().maxAxis()];
  if (!((kind.to - kind.from).length() > btScalar(1e-6) * longest)) {
    cursor.at("to_m").complain("must be another point than from_m");
  }
  return kind;
}

Hull readHull(JsonCursor cursor) {
  cursor.expectObject(keys::hull);
  Hull hull;
  if (cursor.exactlyOneOf({"points_m", "obj"}) == "obj") {
    hull.points = readMesh(cursor.at("obj")).vertices;
  } else {
    for (const JsonCursor& point : cursor.at("points_m").elements()) hull.points.push_back(readVector(point));
  }
  if (hull.points.size() < 4) cursor.complain("must have at least 4 points");
  if (!isSolid(hull.points)) cursor.complain("its points must not lie in one plane");
  return hull;
}

Collider::Shape readShape(const JsonCursor& cursor) {
  const std::string kind = cursor.exactlyOneOf({"plane", "box", "sphere", "capsule", "cylinder", "hull", "mesh"});
  const JsonCursor shape = cursor.at(kind);
  if (kind == "plane") return readPlane(shape);
  if (kind == "box") return readBox(shape);
  if (kind == "sphere") return readSphere(shape);
  if (kind == "capsule") return readLong<Capsule>(shape, keys::capsule);
  if (kind == "cylinder") return readLong<Cylinder>(shape, keys::cylinder);
  if (kind == "hull") return readHull(shape);
  return readMesh(shape);
}

/// About x, y and z, one after the other, as an OBJ is turned.
btQuaternion turnOf(const btVector3& degrees) {
  const btVector3 angles = degrees * SIMD_RADS_PER_DEG;
  return btQuaternion(btVector3(0, 0, 1), angles.z()) * btQuaternion(btVector3(0, 1, 0), angles.y()) *
         btQuaternion(btVector3(1, 0, 0), angles.x());
}

}  // namespace

Box readBox(JsonCursor cursor) {
  cursor.expectObject(keys::box);
  return {readVector(cursor.at("centre_m")), readVector(cursor.at("half_extents_m"), Range::positive())};
}

Sphere readSphere(JsonCursor cursor) {
  cursor.expectObject(keys::sphere);
  return {readVector(cursor.at("centre_m")), cursor.at("radius_m").number(Range::positive())};
}

RigidMotion readRigidMotion(JsonCursor cursor, const btVector3& middle) {
  cursor.expectObject(keys::rigidMotion);
  RigidMotion motion;
  motion.times = readTimes(cursor.at("times_s"));
  motion.pivot = middle;
  readVector(cursor, "about_m", motion.pivot);
  motion.places.assign(motion.times.size(), motion.pivot);
  motion.turns.assign(motion.times.size(), btQuaternion::getIdentity());
  const auto offsets = cursor.find("offsets_m");
  const auto rotations = cursor.find("rotations_deg");
  if (!offsets && !rotations) cursor.complain("must have offsets_m, rotations_deg, or both");
  if (offsets) {
    const std::vector<btVector3> ways = readForEachTime(*offsets, motion.times.size());
    for (std::size_t i = 0; i < ways.size(); ++i) motion.places[i] += ways[i];
  }
  if (rotations) {
    const std::vector<btVector3> angles = readForEachTime(*rotations, motion.times.size());
    for (std::size_t i = 0; i < angles.size(); ++i) motion.turns[i] = turnOf(angles[i]);
  }
  return motion;
}

Collider readCollider(JsonCursor cursor) {
  cursor.expectObject(keys::collider);
  Collider collider(readShape(cursor));
  if (const auto motion = cursor.find("motion")) {
    if (collider.as<Plane>() != nullptr) motion->complain("a plane does not move; a box does");
    collider.motion = readRigidMotion(*motion, middleOf(collider));
  }
  if (!(reachOf(collider) <= farthest)) cursor.complain("must be within 1e8 m of 0 at all times");
  return collider;
}

}  // namespace command
