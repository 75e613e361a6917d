// SPDX-License-Identifier: Zlib
// What is drawn of a collider is the shape that Bullet has: the volume within its pieces tells.

#include "command/scene/ColliderSurface.h"
#include "command/scene/ColliderShape.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace wetcloth_test::collider_surface_test {
namespace {

using command::Collider;

/// By the divergence theorem, if all pieces are counter-clockwise from outside [m^3].
double volumeWithin(const Collider& collider) {
  double volume = 0;
  for (const auto& piece : surfaceOf(collider).pieces) {
    for (std::size_t k = 2; k < piece.corners.size(); ++k) {
      volume += static_cast<double>(piece.corners[0].dot(piece.corners[k - 1].cross(piece.corners[k]))) / 6;
    }
  }
  return volume;
}

struct Case {
  std::string name;
  Collider collider;
  double volume;  // [m^3]
};

std::vector<Case> cases() {
  const btVector3 a(1, 0, 0), b(1, 2, 0);
  std::vector<btVector3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(btScalar(i & 1), btScalar(i & 2), btScalar((i >> 2) & 1));
  return {{"box", Collider(command::Box{a, btVector3(1, 2, 3)}), 48},
          {"sphere", Collider(command::Sphere{a, 2}), 4 * SIMD_PI * 8 / 3},
          {"capsule", Collider(command::Capsule{a, b, 0.5}), SIMD_PI * 0.25 * 2 + 4 * SIMD_PI * 0.125 / 3},
          {"cylinder", Collider(command::Cylinder{a, b, 0.5}), SIMD_PI * 0.25 * 2},
          {"hull", Collider(command::Hull{corners}), 2}};
}

TEST(ColliderSurface, EnclosesItsVolume) {
  for (const Case& each : cases()) {
    // Polyhedra of 64 sides and 32 rings in what is round lack 0.4 % of it.
    EXPECT_NEAR(volumeWithin(each.collider), each.volume, 0.006 * each.volume) << each.name;
  }
}

TEST(ColliderSurface, NormalsPointOutwards) {
  for (const Case& each : cases()) {
    const btVector3 middle = middleOf(each.collider);
    for (const auto& piece : surfaceOf(each.collider).pieces) {
      for (std::size_t k = 0; k < piece.corners.size(); ++k) {
        EXPECT_NEAR(static_cast<double>(piece.normals[k].length()), 1, 1e-4) << each.name;
        EXPECT_GT(piece.normals[k].dot(piece.corners[k] - middle), 0) << each.name;
      }
    }
  }
}

TEST(ColliderShape, HasTheBoundsOfItsSurface) {
  for (const Case& each : cases()) {
    const command::ColliderShape made = shapeOf(each.collider);
    btVector3 low, high;
    made.shape->getAabb(made.rest, low, high);
    for (const auto& piece : surfaceOf(each.collider).pieces) {
      for (const btVector3& corner : piece.corners) {
        // Bullet's bounds of some shapes have a margin of up to 4 cm around them.
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_GE(corner[axis], low[axis] - btScalar(1e-4)) << each.name;
          EXPECT_LE(corner[axis], high[axis] + btScalar(1e-4)) << each.name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace wetcloth_test::collider_surface_test
