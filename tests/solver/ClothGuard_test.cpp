// SPDX-License-Identifier: Zlib
// With the guard no vertex meets a face, and no edge an edge, from small step to small step.
#include "tests/solver/GuardScene.h"
#include "tests/support/InEveryWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wetcloth_test::cloth_guard_test {
namespace {

void expectNothingImposed(const wetcloth::ClothSolver::GuardTotals& totals) {
  EXPECT_EQ(totals.forced, 0);
  EXPECT_EQ(totals.meeting, 0);
  EXPECT_EQ(totals.halts, 0);
}

TEST_IN_POSITION_BASED_WORLDS(ClothGuard, ASheetFallsIntoAHeapAndRests) {
  GuardScene scene(Guard(), GetParam());
  btSoftBody& body = scene.add(wavySheet(16));
  scene.addFloor();
  scene.watch();
  scene.step(180);
  EXPECT_EQ(scene.passages(), 0);
  EXPECT_LT(rmsSpeed(body), 0.02);
  EXPECT_GT(scene.totals().pairs, 0);
  expectNothingImposed(scene.totals());
}

TEST(ClothGuardPromise, WithoutItTheSameSheetPassesThroughItself) {
  GuardScene scene(std::nullopt);
  scene.add(wavySheet(16));
  scene.addFloor();
  scene.watch();
  scene.step(90);
  EXPECT_GT(scene.passages(), 100);
  EXPECT_EQ(scene.totals().looks, 0);
}

// Two that stand side by side fall into one heap.
void dropTwo(GuardScene& scene, int steps = 75) {
  scene.addFloor();
  scene.add(wavySheet(11, 0.6));
  scene.add(wavySheet(12, 0.6, btVector3(btScalar(0.03), btScalar(0.07), btScalar(0.04))));
  scene.watch();
  scene.step(steps);
}

TEST_IN_POSITION_BASED_WORLDS(ClothGuard, TwoClothsFallIntoOneHeap) {
  GuardScene scene(Guard(), GetParam());
  dropTwo(scene);
  EXPECT_EQ(scene.passages(), 0);
  expectNothingImposed(scene.totals());
}

TEST(ClothGuardPromise, WithoutItTheSameClothsPassThroughEachOther) {
  GuardScene scene(std::nullopt);
  dropTwo(scene);
  EXPECT_GT(scene.passages(), 100);
}

TEST(ClothGuardPromise, OnlyWhatIsAskedForIsHeldApart) {
  Guard guard;
  guard.others = false;
  GuardScene scene(guard);
  dropTwo(scene);
  EXPECT_GT(scene.passages(), 100);
}

// One half of a sheet that stands upright flies into the other.
void throwAtItself(GuardScene& scene, double speed, int steps) {
  btSoftBody& body = scene.add(sailPatch(17));
  for (int k = 0; k < body.m_nodes.size(); ++k) {
    const double side = double(body.m_nodes[k].m_x.x()) - 0.5;
    // A little aside, so that the layers do not only meet in the plane of the sheet.
    const double aside = 0.3 * std::sin(7 * double(body.m_nodes[k].m_x.y()));
    body.m_nodes[k].m_v = btVector3(btScalar(side > 0 ? -speed : speed), 0, btScalar(speed * aside));
  }
  scene.watch();
  scene.step(steps);
}

TEST(ClothGuardPromise, ASheetThrownAtItself) {
  GuardScene with(Guard(), WorldKind::softRigid, kNoGravity);
  throwAtItself(with, 30, 30);
  EXPECT_EQ(with.passages(), 0);
  expectNothingImposed(with.totals());
  GuardScene without(std::nullopt, WorldKind::softRigid, kNoGravity);
  throwAtItself(without, 30, 30);
  EXPECT_GT(without.passages(), 100);
}

// Two rods turn against each other, and come together as hands do. The sheet is 1.2 m x 1.6 m.
struct Wringing {
  static constexpr int kColumns = 13;
  static constexpr int kRows = 17;
  static constexpr double kTurns = 2;
  static constexpr int kSteps = 160;

  explicit Wringing(GuardScene& scene) {
    wetcloth::ClothPatch patch;
    patch.columns = kColumns;
    patch.rows = kRows;
    patch.origin = btVector3(btScalar(-0.6), 0, 0);
    patch.edgeU = btVector3(btScalar(1.2), 0, 0);
    patch.edgeV = btVector3(0, btScalar(1.6), 0);
    patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top, wetcloth::ClothPatch::Edge::bottom};
    body = &scene.add(patch);
  }
  void turn(int step) const {
    const double done = double(step) / kSteps;
    const double angle = 2 * 3.14159265358979 * kTurns * done;
    const double halfWidth = 0.6 * (1 - 0.5 * std::min(1.0, 3 * done));
    const double height = 1.6 * (1 - 0.5 * done);
    for (int i = 0; i < kColumns; ++i) {
      const double x = halfWidth * (2.0 * i / (kColumns - 1) - 1);
      body->m_nodes[i].m_x = btVector3(btScalar(x), 0, 0);
      body->m_nodes[(kRows - 1) * kColumns + i].m_x =
          btVector3(btScalar(x * std::cos(angle)), btScalar(height), btScalar(x * std::sin(angle)));
    }
  }
  btSoftBody* body;
};

/// How far links are stretched at most.
double wring(GuardScene& scene) {
  const Wringing wringing(scene);
  scene.watch();
  double stretch = 0;
  for (int step = 1; step <= Wringing::kSteps; ++step) {
    wringing.turn(step);
    scene.step(1);
    stretch = std::max(stretch, largestStretch(*wringing.body));
  }
  return stretch;
}

TEST(ClothGuardPromise, ASheetIsWrung) {
  GuardScene with;
  const double stretch = wring(with);
  EXPECT_EQ(with.passages(), 0);
  expectNothingImposed(with.totals());
  GuardScene without(std::nullopt);
  const double itsOwn = wring(without);
  EXPECT_GT(without.passages(), PassageCheck::kMany);
  EXPECT_LE(stretch, 1.5 * itsOwn) << "links that the rods pull stretch anyway; layers in the way do not double that";
}

// What the guard has seen of a pin is where the application put it, to the last bit: the way there is a sum of small
// steps, each of which is rounded.
TEST(ClothGuardPromise, PinsArriveWhereTheyWerePut) {
  GuardScene scene;
  const Wringing wringing(scene);
  std::vector<btVector3> shown(std::size_t(wringing.body->m_nodes.size()));
  scene.solver().setSmallStepCallback([&](const wetcloth::ClothSolver::SmallStepView& view) {
    for (std::size_t node = 0; node < shown.size(); ++node) {
      const std::size_t slot = std::size_t(view.slots[node]);
      shown[node] = btVector3(view.x[0][slot], view.x[1][slot], view.x[2][slot]) + view.origin;
    }
  });
  for (int step = 1; step <= 10; ++step) {
    wringing.turn(step);
    scene.step(1);
    for (int node = 0; node < wringing.body->m_nodes.size(); ++node) {
      if (wringing.body->m_nodes[node].m_im > 0) continue;
      EXPECT_EQ(shown[std::size_t(node)], wringing.body->m_nodes[node].m_x) << node;
    }
  }
}

// Two cloths in weightlessness that fly into each other: what one loses the other gains.
TEST_IN_POSITION_BASED_WORLDS(ClothGuard, ClothsThatCollideKeepTheirMomentum) {
  GuardScene scene(Guard(), GetParam(), kNoGravity);
  btSoftBody& lower = scene.add(levelSheet(10, 0.5, btVector3(0, 0, 0)));
  btSoftBody& upper = scene.add(levelSheet(11, 0.4, btVector3(btScalar(0.03), btScalar(0.1), btScalar(0.02))));
  lower.m_cfg.kDP = 0;
  upper.m_cfg.kDP = 0;
  setVelocity(upper, btVector3(btScalar(0.5), -3, 0));
  scene.watch();
  const auto before = momentum(upper);
  scene.step(30);
  EXPECT_EQ(scene.passages(), 0);
  EXPECT_LT(double(meanVelocity(lower).y()), -0.5) << "they have met";
  const double mass = freeMass(lower) + freeMass(upper);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double after = momentum(lower)[axis] + momentum(upper)[axis];
    EXPECT_NEAR(after / mass, before[axis] / mass, 1e-3) << "300 roundings of places, 1e-8 m in 1/600 s each";
  }
}

// Layers that begin nearer than the thickness slowly part, and do not stop what they belong to.
TEST(ClothGuardPromise, LayersNearerThanTheThicknessSlowlyPart) {
  for (const btVector3& gravity : {kNoGravity, kEarthGravity}) {
    Guard guard;
    guard.thickness = 0.01;
    GuardScene scene(guard, WorldKind::softRigid, gravity);
    btSoftBody& lower = scene.add(levelSheet(6, 0.3, btVector3(0, 0, 0)));
    const btVector3 near(btScalar(0.01), btScalar(0.003), btScalar(0.013));
    btSoftBody& upper = scene.add(levelSheet(7, 0.3, near));
    scene.watch();
    scene.step(10);
    EXPECT_EQ(scene.passages(), 0);
    EXPECT_EQ(scene.totals().halts, 0);
    const double fall = double(gravity.length()) / 6;
    EXPECT_LT(largestSpeed(lower), fall + 1);
    EXPECT_LT(largestSpeed(upper), fall + 1);
    EXPECT_NEAR(double(meanVelocity(upper).y() + meanVelocity(lower).y()) / 2, -fall, 0.05);
    EXPECT_GT(double(meanPosition(upper).y() - meanPosition(lower).y()), 0.003);
  }
}

struct Variant {
  const char* name;
  Guard guard;
};
std::ostream& operator<<(std::ostream& out, const Variant& variant) { return out << variant.name; }

class ClothGuardSettings : public testing::TestWithParam<Variant> {};
INSTANTIATE_TEST_SUITE_P(, ClothGuardSettings,
                         testing::Values(Variant{"thin", {0, true, true, 5, 0.3}},
                                         Variant{"thickerThanAnEdge", {0.2, true, true, 5, 0.3}},
                                         Variant{"looksInEachSmallStep", {0.002, true, true, 1, 0.3}},
                                         Variant{"seldomLooks", {0.002, true, true, 100, 0.3}},
                                         Variant{"smooth", {0.002, true, true, 5, 0}},
                                         Variant{"rough", {0.002, true, true, 5, 100}}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(ClothGuardSettings, KeepThePromise) {
  GuardScene scene(GetParam().guard);
  dropTwo(scene, 60);
  EXPECT_EQ(scene.passages(), 0);
  expectNothingImposed(scene.totals());
}

// A place in float32 is rounded to 0.2 mm there.
TEST(ClothGuardPromise, FarFromTheOrigin) {
  for (const bool isGuarded : {true, false}) {
    GuardScene scene(isGuarded ? std::optional<Guard>(Guard()) : std::nullopt);
    scene.add(wavySheet(11, 0.6, btVector3(3000, btScalar(0.05), 0)));
    scene.add(wavySheet(10, 0.5, btVector3(3000, btScalar(0.1), btScalar(0.1))));
    scene.addFloor(0, 3000);
    scene.watch();
    scene.step(75);
    if (isGuarded) {
      EXPECT_EQ(scene.passages(), 0);
      expectNothingImposed(scene.totals());
    } else {
      EXPECT_GT(scene.passages(), 100);
    }
  }
}

}  // namespace
}  // namespace wetcloth_test::cloth_guard_test
