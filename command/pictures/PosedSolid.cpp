// SPDX-License-Identifier: Zlib
#include "command/pictures/PosedSolid.h"

#include "command/pictures/VectorMath.h"

namespace pictures {
namespace {

/// v + 2 q x (q x v + w v)
Vector3 turned(const std::array<float, 4>& turn, const Vector3& vector) {
  const Vector3 axis{turn[0], turn[1], turn[2]};
  return vector + cross(axis, cross(axis, vector) + vector * turn[3]) * 2;
}

}  // namespace

Solid posedSolid(const Scenery& scenery, const Frame& frame, std::size_t solid) {
  Solid posed = scenery.solids[solid];
  if (frame.poses.empty()) return posed;
  const Pose& pose = frame.poses[solid];
  for (Vector3& vertex : posed.vertices) vertex = pose.place + turned(pose.turn, vertex);
  for (Vector3& normal : posed.normals) normal = turned(pose.turn, normal);
  return posed;
}

std::vector<Vector3> posedVertices(const Scenery& scenery, const Frame& frame) {
  std::vector<Vector3> all;
  for (std::size_t i = 0; i < scenery.solids.size(); ++i) {
    const Solid solid = posedSolid(scenery, frame, i);
    all.insert(all.end(), solid.vertices.begin(), solid.vertices.end());
  }
  return all;
}

}  // namespace pictures
