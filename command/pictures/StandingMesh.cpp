// SPDX-License-Identifier: Zlib
#include "command/pictures/StandingMesh.h"

#include "command/pictures/Bounds.h"
#include "command/pictures/PosedSolid.h"
#include "command/pictures/VectorMath.h"

#include <algorithm>
#include <cstddef>

namespace pictures {
namespace {

StandingMesh square(const std::string& name, const Ground& plane, const Bounds& bounds, const Rgb& colour) {
  const Vector3 middle = bounds.middle();
  const Vector3 centre = middle + plane.normal * (plane.offset - dot(plane.normal, middle));
  const Vector3 right = perpendicular(plane.normal) * bounds.diagonal();
  const Vector3 ahead = cross(plane.normal, right);
  StandingMesh mesh;
  mesh.name = name;
  mesh.vertices = {centre - right - ahead, centre + right - ahead, centre + right + ahead, centre - right + ahead};
  mesh.normals.assign(4, plane.normal);
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.colour = colour;
  return mesh;
}

/// Without the flat triangles at the poles of a sphere, which some programs take for lines.
std::vector<Triangle> withArea(const Solid& solid) {
  std::vector<Triangle> triangles;
  for (const Triangle& triangle : solid.triangles) {
    const auto corner = [&](std::size_t i) { return solid.vertices[static_cast<std::size_t>(triangle[i])]; };
    const Vector3 sides[3] = {corner(1) - corner(0), corner(2) - corner(1), corner(0) - corner(2)};
    const float longest = std::max({length(sides[0]), length(sides[1]), length(sides[2])});
    if (length(cross(sides[0], sides[1])) > 1e-5F * longest * longest) triangles.push_back(triangle);
  }
  return triangles;
}

}  // namespace

std::vector<StandingMesh> standingMeshes(const FrameSequence& sequence) {
  const Scenery& scenery = sequence.scenery;
  const Bounds bounds = boundsOf(sequence);
  std::vector<StandingMesh> meshes;
  for (std::size_t i = 0; i < scenery.solids.size(); ++i) {
    const Solid solid = posedSolid(scenery, sequence.frames.front(), i);
    meshes.push_back({"solid", solid.vertices, solid.normals, withArea(solid), {0.45F, 0.47F, 0.50F}, i});
  }
  for (const Ground& ground : scenery.grounds) meshes.push_back(square("ground", ground, bounds, {0.5F, 0.5F, 0.5F}));
  if (scenery.waterLevel) {
    meshes.push_back(square("water", {scenery.up, *scenery.waterLevel}, bounds, {0.10F, 0.30F, 0.40F}));
  }
  return meshes;
}

}  // namespace pictures
