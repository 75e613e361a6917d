// SPDX-License-Identifier: Zlib
#include "command/viewer/Picking.h"

#include "command/pictures/PosedSolid.h"
#include "command/viewer/PlainVector.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace viewer {
namespace {

using Corners = std::array<btVector3, 3>;

Corners cornersOf(const std::vector<pictures::Vector3>& places, const pictures::Triangle& triangle) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = bulletVector(places[static_cast<std::size_t>(triangle[k])]);
  return corners;
}

/// Distance along the ray at which it meets a triangle from either side (Moeller & Trumbore 1997).
std::optional<btScalar> meet(const Ray& ray, const Corners& corners) {
  const btVector3 ab = corners[1] - corners[0];
  const btVector3 ac = corners[2] - corners[0];
  const btVector3 across = ray.direction.cross(ac);
  const btScalar determinant = ab.dot(across);
  if (determinant == 0) return std::nullopt;
  const btVector3 towards = ray.origin - corners[0];
  const btScalar u = towards.dot(across) / determinant;
  const btVector3 turned = towards.cross(ab);
  const btScalar v = ray.direction.dot(turned) / determinant;
  const btScalar distance = ac.dot(turned) / determinant;
  if (!(u >= 0 && v >= 0 && u + v <= 1 && distance > 0)) return std::nullopt;
  return distance;
}

btScalar distanceToScenery(const Ray& ray, const pictures::Scenery& scenery, const pictures::Frame& frame) {
  btScalar least = BT_LARGE_FLOAT;
  for (const pictures::Ground& ground : scenery.grounds) {
    const btVector3 normal = bulletVector(ground.normal);
    const btScalar distance = (btScalar(ground.offset) - normal.dot(ray.origin)) / normal.dot(ray.direction);
    if (distance > 0 && distance < least) least = distance;
  }
  for (std::size_t i = 0; i < scenery.solids.size(); ++i) {
    const pictures::Solid solid = pictures::posedSolid(scenery, frame, i);
    for (const pictures::Triangle& triangle : solid.triangles) {
      const auto distance = meet(ray, cornersOf(solid.vertices, triangle));
      if (distance && *distance < least) least = *distance;
    }
  }
  return least;
}

int nearestCorner(const btVector3& point, const Corners& corners, const pictures::Triangle& triangle) {
  std::size_t chosen = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if ((corners[k] - point).length2() < (corners[chosen] - point).length2()) chosen = k;
  }
  return triangle[chosen];
}

}  // namespace

std::optional<Hit> pickCloth(const Ray& ray, const pictures::Scenery& scenery,
                             const std::vector<pictures::ClothShape>& cloths, const pictures::Frame& frame) {
  std::optional<Hit> hit;
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    for (const pictures::Triangle& triangle : cloths[i].triangles) {
      const Corners corners = cornersOf(frame.cloths[i].positions, triangle);
      const auto distance = meet(ray, corners);
      if (!distance || (hit && hit->distance <= *distance)) continue;
      const btVector3 point = ray.origin + ray.direction * *distance;
      hit = Hit{static_cast<int>(i), nearestCorner(point, corners, triangle), *distance};
    }
  }
  if (hit && hit->distance > distanceToScenery(ray, scenery, frame)) return std::nullopt;
  return hit;
}

}  // namespace viewer
