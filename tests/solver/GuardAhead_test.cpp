// SPDX-License-Identifier: Zlib
// What the guard leaves out for small steps ahead is known of all nodes at one time.
#include "bullet_wetcloth/solver/ClothGuard.h"
#include "tests/solver/GuardScene.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace wetcloth_test::guard_ahead_test {
namespace {

constexpr int kSmallSteps = 10;

// A triangle that is put where a test wants it.
class Triangle {
 public:
  Triangle(SolverScene& scene, const std::vector<btVector3>& corners) {
    const btSoftBody& body = scene.add(linkedTriangles(corners, {{0, 1, 2}}));
    m_mesh = wetcloth::guardMeshOf(body, std::nullopt);
    for (wetcloth::PackedNodes::Lane& lane : m_lanes) lane.assign(2 * wetcloth::PackedNodes::kPadding, 0);
    for (std::size_t k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) m_lanes[axis][k] = corners[k][axis];
      m_lanes[kInverseMass][k] = 1;
    }
  }
  void moveBy(double up) {
    for (std::size_t k = 0; k < 3; ++k) {
      m_lanes[1][k] += btScalar(up);
      m_lanes[kPredicted + 1][k] = m_lanes[1][k];
    }
  }
  void goesUp(double speed) {
    for (std::size_t k = 0; k < 3; ++k) m_lanes[kVelocity + 1][k] = btScalar(speed);
  }
  btVector3 placeOf(std::size_t corner) const {
    return btVector3(m_lanes[0][corner], m_lanes[1][corner], m_lanes[2][corner]);
  }
  // Whether this is above the plane of the triangle.
  bool isUnder(const btVector3& place) const {
    const btVector3 down = (placeOf(1) - placeOf(0)).cross(placeOf(2) - placeOf(0));
    return down.dot(place - placeOf(0)) < 0;
  }
  wetcloth::ClothGuard::Cloth cloth() {
    wetcloth::ClothGuard::Cloth cloth = {};
    cloth.mesh = &m_mesh;
    cloth.nodes.count = wetcloth::PackedNodes::kPadding;
    for (int axis = 0; axis < 3; ++axis) {
      cloth.nodes.position[axis] = m_lanes[axis].data();
      cloth.nodes.predicted[axis] = m_lanes[kPredicted + axis].data();
      cloth.nodes.velocity[axis] = m_lanes[kVelocity + axis].data();
    }
    cloth.nodes.inverseMass = m_lanes[kInverseMass].data();
    cloth.slots = kSlots;
    cloth.nodeCount = 3;
    cloth.origin = btVector3(0, 0, 0);
    cloth.h = 1;
    return cloth;
  }

 private:
  static constexpr int kPredicted = 3;
  static constexpr int kVelocity = 6;
  static constexpr int kInverseMass = 9;
  static constexpr int kSlots[3] = {0, 1, 2};

  wetcloth::GuardMesh m_mesh;
  wetcloth::PackedNodes::Lane m_lanes[10];
};

// Two that go up at the same speed, near each other. Then the upper one gets a little faster, as if it would get away,
// and falls back at once: by less than it may leave its way. How far they are apart was known at that time only, not
// where the lower one was when it was looked at first.
TEST(GuardAhead, WhatLeavesItsWayIsComparedWithWhereOthersAreThen) {
  SolverScene scene;
  const double speed = 0.1;  // in a small step, of an edge
  Triangle lower(scene, {btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0.5, 0, 0.9)});
  Triangle upper(scene, {btVector3(0.5, 0.001, 0.3), btVector3(0, 0.8, 0.3), btVector3(1, 0.8, 0.3)});
  for (Triangle* const triangle : {&lower, &upper}) triangle->goesUp(speed);
  Guard parameters;
  parameters.every = kSmallSteps;
  parameters.thickness = 0;
  wetcloth::ClothGuard guard;
  guard.begin({lower.cloth(), upper.cloth()}, parameters, kSmallSteps);
  for (int k = 0; k < kSmallSteps; ++k) {
    constexpr int kLeaves = 3;
    lower.moveBy(k > kLeaves ? speed + 0.025 : speed);
    upper.moveBy(k == kLeaves ? speed + 0.036 : k == kLeaves + 1 ? speed - 0.02 : speed);
    guard.hold();
    ASSERT_TRUE(lower.isUnder(upper.placeOf(0))) << "small step " << k;
  }
  EXPECT_EQ(guard.totals().halts, 0);
}

}  // namespace
}  // namespace wetcloth_test::guard_ahead_test
