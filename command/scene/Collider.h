// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/RigidMotion.h"
#include "command/scene/TriangleMesh.h"

#include <LinearMath/btVector3.h>

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace command {

struct Plane {
  btVector3 normal;  ///< of length 1
  double offset;     ///< points p of the plane: normal . p = offset [m]
};
struct Box {
  btVector3 centre;
  btVector3 halfExtents;
};
struct Sphere {
  btVector3 centre;
  double radius;
};
/// All that is within a radius of a line.
struct Capsule {
  btVector3 from;
  btVector3 to;
  double radius;
};
/// With flat ends.
struct Cylinder {
  btVector3 from;
  btVector3 to;
  double radius;
};
/// The convex hull of these points.
struct Hull {
  std::vector<btVector3> points;
};

/// Something rigid that cloth meets. Its shape is told as it is at rest.
struct Collider {
  using Shape = std::variant<Plane, Box, Sphere, Capsule, Cylinder, Hull, TriangleMesh>;

  Shape shape;
  std::optional<RigidMotion> motion;  ///< none: it stays

  template <class Kind>
  Collider(Kind kind) : shape(std::move(kind)) {}  // NOLINT(google-explicit-constructor): a sphere is a collider

  template <class Kind>
  const Kind* as() const {
    return std::get_if<Kind>(&shape);
  }
  /// Where it is at this time [s]: takes a point of it at rest to its place.
  btTransform at(double time) const { return motion ? motion->at(time) : btTransform::getIdentity(); }
};

/// Whether these points do not lie in one plane.
bool isSolid(const std::vector<btVector3>& points);

/// Of what is no plane: where its middle is at rest.
btVector3 middleOf(const Collider& collider);
/// No less than how far any of its points is from 0 at any time [m]; of a plane, the nearest.
double reachOf(const Collider& collider);
/// No less than the speed of any of its points at any time [m/s].
double fastestOf(const Collider& collider);

/// Colliders that stand for a person's body: Scene::colliders from `first` on.
struct FigureScene {
  std::string name;
  std::size_t first = 0;
  std::size_t count = 0;
};

}  // namespace command
