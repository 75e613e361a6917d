// SPDX-License-Identifier: Zlib
#include "command/scene/FigureReader.h"

#include "command/scene/ColliderReader.h"
#include "command/scene/ReadMesh.h"
#include "command/scene/ReadParameters.h"
#include "command/scene/SkeletonMotion.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace command {
namespace {

using Joint = SkeletonMotion::Joint;

constexpr int directionsOfHull = 100;  // a polyhedron in a ball then lacks 2 % of its radius at most

/// Spread evenly over the sphere: a spiral whose turns are as far apart as its points (golden angle).
btVector3 direction(int i) {
  const double height = 1 - (2 * i + 1.0) / directionsOfHull;
  const double around = i * SIMD_PI * (3 - std::sqrt(5.0));
  const double reach = std::sqrt(1 - height * height);
  return btVector3(btScalar(reach * std::cos(around)), btScalar(height), btScalar(reach * std::sin(around)));
}

/// The farthest points of the spheres in all directions.
Hull hullOf(const std::vector<Sphere>& spheres) {
  Hull hull;
  for (int i = 0; i < directionsOfHull; ++i) {
    const btVector3 out = direction(i);
    const auto height = [&](const Sphere& s) { return s.centre.dot(out) + btScalar(s.radius); };
    const auto farthest = std::max_element(spheres.begin(), spheres.end(),
                                           [&](const Sphere& a, const Sphere& b) { return height(a) < height(b); });
    hull.points.push_back(farthest->centre + out * btScalar(farthest->radius));
  }
  return hull;
}

const Joint& jointAt(const JsonCursor& name, const SkeletonMotion& motion) {
  std::vector<std::pair<std::string, const Joint*>> joints;
  for (const Joint& joint : motion.joints) joints.emplace_back(joint.name, &joint);
  return *name.choice(joints);
}

/// What of a figure follows one joint.
struct Part {
  const Joint* joint;
  std::vector<Sphere> spheres;
};

std::vector<Part> readPartsIn(const JsonCursor& list, const SkeletonMotion& motion) {
  std::vector<Part> parts;
  for (JsonCursor element : list.elements()) {
    element.expectObject(keys::part);
    Part part{&jointAt(element.at("joint"), motion), {}};
    for (const JsonCursor& sphere : element.at("spheres").elements()) part.spheres.push_back(readSphere(sphere));
    if (part.spheres.empty()) element.at("spheres").reject("an array with at least one sphere");
    parts.push_back(std::move(part));
  }
  if (parts.empty()) list.reject("an array with at least one part");
  return parts;
}

/// In the scene itself or in a file of their own.
std::vector<Part> readParts(const JsonCursor& cursor, const SkeletonMotion& motion) {
  if (!cursor.isText()) return readPartsIn(cursor, motion);
  const std::string file = fileBeside(cursor);
  const Json json = loadJson(file);
  JsonCursor root(json, file);
  root.expectObject(keys::parts);
  return readPartsIn(root.at("parts"), motion);
}

/// Of a file that has no skin: a bone of this radius [m] from each joint to the next.
std::vector<Part> bonesOf(const SkeletonMotion& motion, double radius) {
  std::vector<Part> parts;
  for (const Joint& joint : motion.joints) {
    for (const btVector3& end : joint.ends) {
      if (end.length() > 0) parts.push_back({&joint, {{btVector3(0, 0, 0), radius}, {end, radius}}});
    }
  }
  return parts;
}

/// Hulls of what follows each joint. A flat or small rest of skin is none.
std::vector<std::pair<const Joint*, Hull>> hullsOfSkin(const SkeletonMotion& motion) {
  std::vector<std::pair<const Joint*, Hull>> hulls;
  for (const Joint& joint : motion.joints) {
    std::vector<Sphere> points;
    for (const btVector3& vertex : joint.skin) points.push_back({vertex, 0});
    Hull hull;
    if (!points.empty()) hull = hullOf(points);
    if (isSolid(hull.points)) hulls.emplace_back(&joint, std::move(hull));
  }
  return hulls;
}

std::vector<std::pair<const Joint*, Hull>> readHulls(const JsonCursor& cursor, const SkeletonMotion& motion) {
  double radius = 0.05;
  readNumber(cursor, "bone_radius_m", Range::positive(), radius);
  const auto given = cursor.find("parts");
  std::vector<std::pair<const Joint*, Hull>> hulls;
  if (!given) hulls = hullsOfSkin(motion);
  if (!hulls.empty()) return hulls;
  for (const Part& part : given ? readParts(*given, motion) : bonesOf(motion, radius)) {
    hulls.emplace_back(part.joint, hullOf(part.spheres));
  }
  if (hulls.empty()) cursor.complain("its motion file has no bones and no skin: name its \"parts\"");
  return hulls;
}

SkeletonMotion readMotionFile(const JsonCursor& name, const Placement& placement) {
  const std::string file = fileBeside(name);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) name.complain("no such file: " + file);
  try {
    return readSkeletonMotion(file, placement);
  } catch (const std::invalid_argument& error) {
    name.complain(error.what());
  }
}

RigidMotion motionOf(const Joint& joint, const std::vector<double>& times) {
  RigidMotion motion;
  motion.times = times;
  for (const btTransform& place : joint.places) {
    motion.places.push_back(place.getOrigin());
    motion.turns.push_back(place.getRotation());
  }
  return motion;
}

}  // namespace

void readFigure(JsonCursor cursor, Scene& scene) {
  cursor.expectObject(keys::figure);
  const SkeletonMotion motion = readMotionFile(cursor.at("motion"), readPlacement(cursor));
  FigureScene figure;
  figure.name = "figure " + std::to_string(scene.figures.size());
  if (const auto name = cursor.find("name")) figure.name = name->text();
  figure.first = scene.colliders.size();
  const auto path = cursor.find("path");
  for (const auto& [joint, hull] : readHulls(cursor, motion)) {
    Collider part(hull);
    part.motion = motionOf(*joint, motion.times);
    if (path)
      part.motion = chained(*part.motion, readRigidMotion(*path, motion.joints.front().places.front().getOrigin()));
    scene.colliders.push_back(std::move(part));
  }
  figure.count = scene.colliders.size() - figure.first;
  scene.figures.push_back(figure);
}

}  // namespace command
