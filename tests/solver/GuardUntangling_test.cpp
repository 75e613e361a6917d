// SPDX-License-Identifier: Zlib
// A start that is entangled is untangled, or left as it is, by choice; it does not explode nor freeze the rest.
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/solver/TangledCloths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace wetcloth_test::guard_untangling_test {
namespace {

const btVector3 kNoGravity(0, 0, 0);
// Parts are drawn apart at 0.5 m/s; a fold that they draw together bulges a few times as fast.
constexpr double kFast = 3;

using Bodies = std::vector<const btSoftBody*>;

bool wasTold(GuardScene& scene, const std::string& what) {
  for (const std::string& message : scene.scene().messages()) {
    if (message.find(what) != std::string::npos) return true;
  }
  return false;
}

// Returns the largest speed on the way.
double stepAndMeasure(GuardScene& scene, int count, const Bodies& bodies) {
  double fastest = 0;
  for (int k = 0; k < count; ++k) {
    scene.step(1);
    for (const btSoftBody* body : bodies) fastest = std::max(fastest, largestSpeed(*body));
  }
  return fastest;
}

void expectUntangled(GuardScene& scene, const Bodies& bodies, int steps = 180) {
  ASSERT_GT(countCrossings(bodies), 5);
  EXPECT_LT(stepAndMeasure(scene, steps, bodies), kFast);
  EXPECT_EQ(countCrossings(bodies), 0);
  EXPECT_EQ(scene.totals().halts, 0);
  EXPECT_GT(scene.totals().crossing, 5);
  EXPECT_TRUE(wasTold(scene, "they are untangled"));
  EXPECT_TRUE(wasTold(scene, "no edge of a cloth crosses a face any more"));
  EXPECT_EQ(scene.scene().messages().size(), 2u) << "each is told once";
  for (const btSoftBody* body : bodies) {
    EXPECT_TRUE(isFinite(*body));
    EXPECT_LT(largestStretch(*body), 1.1);
  }
}

TEST(GuardUntangling, ACornerThroughASheetComesBack) {
  for (const WorldKind kind : {WorldKind::softRigid, WorldKind::softMultiBody}) {
    GuardScene scene(untangling(), kind, kNoGravity);
    const auto cloths = addCornerThroughSheet(scene, 0.05);
    expectUntangled(scene, {cloths.first, cloths.second});
  }
}

// The corner's tip is 5 cm below the sheet, y = 0, at (0.013, 0.008), and its edges are 3 cm long. A cloth far away
// comes first, so that nodes are not counted from the sheet's.
TEST(GuardUntangling, TheFirstCrossingIsToldWithItsPlace) {
  GuardScene scene(untangling(), WorldKind::softRigid, kNoGravity);
  scene.add(levelSheet(5, 0.3, btVector3(5, 5, 5)));
  addCornerThroughSheet(scene, 0.05);
  scene.step(1);
  ASSERT_FALSE(scene.scene().messages().empty());
  const std::string message = scene.scene().messages().front();
  const std::string before = "the first near (";
  const std::size_t at = message.find(before);
  ASSERT_NE(at, std::string::npos) << message;
  double x = 9, y = 9, z = 9;
  ASSERT_EQ(std::sscanf(message.c_str() + at + before.size(), "%lf, %lf, %lf) m", &x, &y, &z), 3) << message;
  EXPECT_NEAR(x, 0.013, 0.15) << message;
  EXPECT_NEAR(y, 0, 0.06) << message;
  EXPECT_NEAR(z, 0.008, 0.15) << message;
}

TEST(GuardUntangling, WhatWasUntangledFallsOnAndPassesNothing) {
  for (const WorldKind kind : {WorldKind::softRigid, WorldKind::softMultiBody}) {
    GuardScene scene(untangling(), kind);
    const auto cloths = addCornerThroughSheet(scene, 0.05);
    scene.step(180);
    ASSERT_EQ(countCrossings({cloths.first, cloths.second}), 0);
    double lowest = 0;
    for (int k = 0; k < cloths.second->m_nodes.size(); ++k) {
      lowest = std::min(lowest, double(cloths.second->m_nodes[k].m_x.y()));
    }
    EXPECT_GT(lowest, -0.2) << "it lies on the other one";
    cloths.second->addVelocity(btVector3(btScalar(0.5), 1, 0));  // up, and down again
    scene.watch();
    scene.step(60);
    EXPECT_EQ(scene.passages(), 0);
    EXPECT_EQ(scene.totals().halts, 0);
  }
}

// One is pinned in front of the other and hangs through it: gravity wants it in front.
TEST(GuardUntangling, HangingSheetsThatCrossAlongALineComeApart) {
  GuardScene scene(untangling());
  wetcloth::ClothPatch patch = squarePatch(11);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  patch.origin = btVector3(btScalar(-0.25), 0, 0);
  patch.edgeU = btVector3(btScalar(0.5), 0, 0);
  patch.edgeV = btVector3(0, btScalar(0.5), 0);
  const btSoftBody& straight = scene.add(patch);
  patch = squarePatch(10);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  patch.origin = btVector3(btScalar(-0.19), btScalar(0.03), btScalar(-0.06));
  patch.edgeU = btVector3(btScalar(0.4), 0, 0);
  patch.edgeV = btVector3(0, btScalar(0.48), btScalar(0.12));
  expectUntangled(scene, {&straight, &scene.add(patch)});
}

// The line goes from a border of the one to a border of the other.
TEST(GuardUntangling, SheetsThatCrossFromBorderToBorderSlideApart) {
  GuardScene scene(untangling(), WorldKind::softRigid, kNoGravity);
  const btSoftBody& level = scene.add(levelSheet(9, 0.3, btVector3(btScalar(-0.1), 0, btScalar(0.004))));
  wetcloth::ClothPatch patch = squarePatch(10);
  patch.origin = btVector3(btScalar(0.003), btScalar(-0.15), 0);
  patch.edgeU = btVector3(btScalar(0.3), 0, btScalar(0.002));
  patch.edgeV = btVector3(0, btScalar(0.3), 0);
  expectUntangled(scene, {&level, &scene.add(patch)});
}

// A grid, and a mesh without rows.
TEST(GuardUntangling, AFoldThroughItselfComesOutOfItself) {
  std::mt19937 random(5);
  const Triangles mesh = rolledSheet(21, 0.8);
  for (const Triangles& sheet : {mesh, mesh.shuffled(random)}) {
    GuardScene scene(untangling(), WorldKind::softRigid, kNoGravity);
    expectUntangled(scene, {&scene.add(sheet.builder())});
  }
}

// The curve is closed: nothing of it is at a border.
TEST(GuardUntangling, ABulgeThroughASheetComesBack) {
  GuardScene scene(untangling(), WorldKind::softRigid, kNoGravity);
  wetcloth::ClothPatch patch = levelSheet(13, 0.6, btVector3(0, 0, 0));
  using Edge = wetcloth::ClothPatch::Edge;
  patch.pinnedEdges = {Edge::left, Edge::right, Edge::bottom, Edge::top};
  const btSoftBody& sheet = scene.add(patch);
  Triangles bulged = Triangles::of(levelSheet(15, 0.4, btVector3(btScalar(0.011), btScalar(0.015), btScalar(0.007))));
  for (btVector3& place : bulged.places) {
    const double away = std::hypot(double(place.x()) - 0.011, double(place.z()) - 0.007) / 0.05;
    place.setY(place.y() - btScalar(0.06 * std::exp(-away * away)));
  }
  expectUntangled(scene, {&sheet, &scene.add(bulged.builder())});
}

// A third cloth hangs far away.
TEST(GuardUntangling, IsAChoiceAndByDefaultCrossingsAreLeftAsTheyAre) {
  GuardScene scene;
  const auto cloths = addCornerThroughSheet(scene, 0.05);
  wetcloth::ClothPatch patch = levelSheet(6, 0.3, btVector3(2, 0, 0));
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::left};
  const btSoftBody& rest = scene.add(patch);
  const int crossings = countCrossings({cloths.first, cloths.second});
  const double fastest = stepAndMeasure(scene, 180, {cloths.first, cloths.second});
  EXPECT_LT(fastest, 4) << "it swings on what it goes through";
  EXPECT_GE(countCrossings({cloths.first, cloths.second}), crossings / 2);
  EXPECT_EQ(scene.totals().crossing, crossings);
  EXPECT_EQ(scene.totals().halts, 0);
  EXPECT_TRUE(wasTold(scene, "they are left as they are"));
  EXPECT_EQ(scene.scene().messages().size(), 1u);
  EXPECT_LT(double(rest.m_nodes[5].m_x.y()), -0.15) << "the rest is not frozen";
}

// An upright sheet is pinned above and below a level one that is pinned all around: it cannot be drawn out.
TEST(GuardUntangling, WhatCannotBeUntangledStaysToldAndTheRestGoesOn) {
  GuardScene scene(untangling());
  wetcloth::ClothPatch patch = levelSheet(13, 0.5, btVector3(0, 0, 0));
  using Edge = wetcloth::ClothPatch::Edge;
  patch.pinnedEdges = {Edge::left, Edge::right, Edge::bottom, Edge::top};
  const btSoftBody& level = scene.add(patch);
  patch = squarePatch(10);
  patch.origin = btVector3(btScalar(-0.11), btScalar(-0.16), btScalar(0.01));
  patch.edgeU = btVector3(btScalar(0.25), 0, btScalar(0.012));
  patch.edgeV = btVector3(0, btScalar(0.3), btScalar(0.02));
  patch.pinnedEdges = {Edge::bottom, Edge::top};
  const btSoftBody& upright = scene.add(patch);
  patch = levelSheet(6, 0.3, btVector3(2, 0, 0));
  patch.pinnedEdges = {Edge::left};
  const btSoftBody& rest = scene.add(patch);
  EXPECT_LT(stepAndMeasure(scene, 300, {&level, &upright}), kFast);
  EXPECT_GT(countCrossings({&level, &upright}), 0);
  EXPECT_TRUE(isFinite(level) && isFinite(upright));
  EXPECT_EQ(scene.totals().halts, 0);
  EXPECT_TRUE(wasTold(scene, "still cross, and for 2 s they got no fewer"));
  EXPECT_LE(scene.scene().messages().size(), 3u) << "not in each step";
  EXPECT_LT(double(rest.m_nodes[5].m_x.y()), -0.15);
  scene.solver().resetGuardTotals();
  scene.step(1);
  EXPECT_GT(scene.totals().crossing, 0);
}

// Each push is equal and opposite, and so are links: what is left is the rounding of places in each small step. A place
// near 1 m is rounded by eps / 2, at random; nodes' roundings over 1800 small steps add up to less than 40 eps, and
// velocities to that over h.
TEST(GuardUntangling, KeepsMomentumAndTheCentreOfMass) {
  GuardScene scene(untangling(), WorldKind::softRigid, kNoGravity);
  const auto cloths = addCornerThroughSheet(scene, 0.05, false);
  const Bodies bodies = {cloths.first, cloths.second};
  double mass = 0;
  const auto centre = [&] {
    std::array<double, 3> sum = {0, 0, 0};
    mass = 0;
    for (const btSoftBody* body : bodies) {
      for (int k = 0; k < body->m_nodes.size(); ++k) {
        const double own = 1 / double(body->m_nodes[k].m_im);
        mass += own;
        for (int axis = 0; axis < 3; ++axis) sum[std::size_t(axis)] += own * double(body->m_nodes[k].m_x[axis]);
      }
    }
    for (double& part : sum) part /= mass;
    return sum;
  };
  const std::array<double, 3> before = centre();
  scene.step(180);
  ASSERT_EQ(countCrossings(bodies), 0);
  const std::array<double, 3> after = centre();
  const double eps = double(std::numeric_limits<btScalar>::epsilon());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double sum = momentum(*bodies[0])[axis] + momentum(*bodies[1])[axis];
    EXPECT_NEAR(sum / mass, 0, 40 * eps * 600) << axis;
    EXPECT_NEAR(after[axis], before[axis], 3 * 40 * eps * 600) << axis;
  }
}

TEST(GuardUntangling, ChangesNoBitWhereNothingCrosses) {
  std::vector<btScalar> states[2];
  for (const bool untangles : {false, true}) {
    GuardScene scene(untangles ? untangling() : Guard());
    scene.addFloor();
    const btSoftBody& sheet = scene.add(wavySheet(10, 0.6));
    scene.step(60);
    EXPECT_EQ(scene.totals().crossing, 0);
    states[untangles ? 1 : 0] = stateOf(sheet);
  }
  EXPECT_TRUE(sameBits(states[0], states[1]));
}

TEST(GuardUntangling, GoesOnBitForBitAfterARestore) {
  GuardScene first(untangling());
  const auto cloths = addCornerThroughSheet(first, 0.05);
  wetcloth::WetClothWorld wet(first.scene().bullet().world());
  first.step(4);
  std::ostringstream saved;
  wet.save(saved);
  ASSERT_GT(countCrossings({cloths.first, cloths.second}), 0);
  first.step(20);
  GuardScene second(untangling());
  const auto others = addCornerThroughSheet(second, 0.05);
  wetcloth::WetClothWorld otherWet(second.scene().bullet().world());
  std::istringstream stream(saved.str());
  otherWet.restore(stream);
  second.step(20);
  EXPECT_TRUE(sameBits(stateOf(*cloths.first), stateOf(*others.first)));
  EXPECT_TRUE(sameBits(stateOf(*cloths.second), stateOf(*others.second)));
}

}  // namespace
}  // namespace wetcloth_test::guard_untangling_test
