// SPDX-License-Identifier: Zlib
// Sides of a cut and of a seam stand at one place, and come apart as if there were no guard; then they are kept apart.
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/solver/GuardScene.h"

#include <BulletSoftBody/btSoftBodyInternals.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace wetcloth_test::cloth_guard_cuts_test {
namespace {

constexpr int kNodes = 13;  // of a side
constexpr double kSide = 0.6;
constexpr double kEdge = kSide / (kNodes - 1);

/// Negative on one side of where a cloth is cut.
struct Blade : btSoftBody::ImplicitFn {
  using Distance = btScalar (*)(const btVector3&);
  explicit Blade(Distance distance) : distanceOf(distance) {}
  btScalar Eval(const btVector3& x) override { return distanceOf(x); }
  Distance distanceOf;
};

void cut(btSoftBody& body, Blade::Distance distance) {
  Blade blade(distance);
  body.refine(&blade, btScalar(0.001), true);
}

// Upright, its top at height 0.
wetcloth::ClothPatch hangingPatch() {
  wetcloth::ClothPatch patch = squarePatch(kNodes);
  patch.origin = btVector3(btScalar(-kSide / 2), btScalar(-kSide), 0);
  patch.edgeU = btVector3(btScalar(kSide), 0, 0);
  patch.edgeV = btVector3(0, btScalar(kSide), 0);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  return patch;
}

/// Which nodes hang together with a pinned one, by links.
std::vector<bool> hanging(const btSoftBody& body) {
  std::vector<bool> isHanging;
  for (int k = 0; k < body.m_nodes.size(); ++k) isHanging.push_back(!(body.m_nodes[k].m_im > 0));
  for (bool isChanged = true; isChanged;) {
    isChanged = false;
    for (int k = 0; k < body.m_links.size(); ++k) {
      const auto a = std::size_t(numberOf(body, body.m_links[k].m_n[0]));
      const auto b = std::size_t(numberOf(body, body.m_links[k].m_n[1]));
      isChanged = isChanged || isHanging[a] != isHanging[b];
      isHanging[a] = isHanging[b] = isHanging[a] || isHanging[b];
    }
  }
  return isHanging;
}

/// Of the nodes that do not hang, by mass.
btVector3 meanFall(const btSoftBody& body, const std::vector<bool>& isHanging) {
  btVector3 sum(0, 0, 0);
  btScalar mass = 0;
  for (int k = 0; k < body.m_nodes.size(); ++k) {
    if (isHanging[std::size_t(k)]) continue;
    sum += body.m_nodes[k].m_v / body.m_nodes[k].m_im;
    mass += 1 / body.m_nodes[k].m_im;
  }
  return sum / mass;
}

struct Cut {
  const char* name;
  Blade::Distance distance;
};
std::ostream& operator<<(std::ostream& out, const Cut& cut) { return out << cut.name; }

class ClothGuardCuts : public testing::TestWithParam<Cut> {};
INSTANTIATE_TEST_SUITE_P(
    , ClothGuardCuts,
    testing::Values(Cut{"alongARow", [](const btVector3& x) { return x.y() + btScalar(0.3); }},
                    Cut{"betweenRows", [](const btVector3& x) { return x.y() + btScalar(0.321); }},
                    Cut{"across", [](const btVector3& x) { return x.y() + btScalar(0.3) - btScalar(0.4) * x.x(); }},
                    Cut{"inWaves",
                        [](const btVector3& x) { return x.y() + btScalar(0.3) - btScalar(0.05) * btSin(x.x() * 20); }}),
    [](const auto& test) { return std::string(test.param.name); });

/// Bullet's cut leaves slivers, and parts nearer than the thickness are parted: links about as short do not count.
double largestStretchOfLong(const btSoftBody& body) {
  double largest = 0;
  for (int k = 0; k < body.m_links.size(); ++k) {
    const btSoftBody::Link& link = body.m_links[k];
    if (double(link.m_rl) < 2 * Guard().thickness) continue;
    largest = std::max(largest, double((link.m_n[0]->m_x - link.m_n[1]->m_x).length() / link.m_rl));
  }
  return largest;
}

/// A sheet that has hung still is cut, and goes on for a third of a second.
struct CutSheet {
  CutSheet(std::optional<Guard> guard, Blade::Distance distance) : scene(guard), body(scene.add(hangingPatch())) {
    body.m_cfg.kDP = 0;
    scene.step(30);
    cut(body, distance);
    isHanging = hanging(body);
    before = meanFall(body, isHanging);
    scene.step(20);
  }
  GuardScene scene;
  btSoftBody& body;
  std::vector<bool> isHanging;
  btVector3 before;
};

// Nothing brakes it but rounding and what is left of the swing of its links, which has no mean.
TEST_P(ClothGuardCuts, PartThatIsCutOffFallsFreely) {
  CutSheet sheet(Guard(), GetParam().distance);
  ASSERT_GT(std::count(sheet.isHanging.begin(), sheet.isHanging.end(), false), kNodes * 3);
  const double g = 9.81;
  EXPECT_NEAR(double((meanFall(sheet.body, sheet.isHanging) - sheet.before).y()), -g * 20 / 60, 0.005);
  EXPECT_EQ(sheet.scene.totals().halts, 0);
  EXPECT_EQ(sheet.scene.totals().stopped, 0);
  CutSheet other(std::nullopt, GetParam().distance);
  EXPECT_LT(largestStretchOfLong(sheet.body), largestStretchOfLong(other.body) + 0.01);
}

TEST_P(ClothGuardCuts, IsNoCrossing) {
  GuardScene scene;
  btSoftBody& body = scene.add(hangingPatch());
  scene.step(10);
  cut(body, GetParam().distance);
  scene.step(60);
  EXPECT_EQ(scene.totals().crossing, 0);
  EXPECT_EQ(scene.scene().messages(), std::vector<std::string>{});
}

// Two halves that hang side by side, with a breath of wind so that their sides are not in line. One is carried away.
struct DoorCut {
  DoorCut(std::optional<Guard> guard, Blade::Distance distance, unsigned chance, Blade::Distance second = nullptr)
      : scene(guard), body(scene.add(hangingPatch())) {
    scene.step(30);
    cut(body, distance);
    for (int k = 0; k < body.m_nodes.size(); ++k) {
      if (distance(body.m_nodes[k].m_x) > btScalar(kEdge / 2)) stays.push_back(k);
    }
    std::mt19937 random(chance);
    std::uniform_real_distribution<double> speed(-0.05, 0.05);
    for (int k = 0; k < body.m_nodes.size(); ++k) {
      if (body.m_nodes[k].m_im > 0) body.m_nodes[k].m_v.setZ(btScalar(speed(random)));
    }
    scene.step(60);
    if (second) cut(body, second);
    for (int step = 0; step < 60; ++step) {
      for (int k = 0; k < body.m_nodes.size(); ++k) {
        btSoftBody::Node& node = body.m_nodes[k];
        if (node.m_im > 0 || distance(node.m_x) > 0) continue;
        node.m_x.setZ(node.m_x.z() + btScalar(0.01));
        node.m_q = node.m_x;
      }
      scene.step(1);
    }
  }
  // Of the half that was not carried, but for what is at the cut.
  double meanAway() const {
    double sum = 0;
    for (const int node : stays) sum += double(body.m_nodes[node].m_x.z());
    return sum / double(stays.size());
  }
  GuardScene scene;
  btSoftBody& body;
  std::vector<int> stays;
};

class ClothGuardDoors : public testing::TestWithParam<Cut> {};
INSTANTIATE_TEST_SUITE_P(
    , ClothGuardDoors,
    testing::Values(Cut{"alongAColumn", [](const btVector3& x) { return x.x() + btScalar(0.0005); }},
                    Cut{"besideAColumn", [](const btVector3& x) { return x.x() + btScalar(0.0015); }},
                    Cut{"betweenColumns", [](const btVector3& x) { return x.x() + btScalar(0.021); }}),
    [](const auto& test) { return std::string(test.param.name); });

// Held to each other, a quarter of the way that the other one goes (0.15 m) was seen. What is left of the breath moves
// it by a few millimetres.
TEST_P(ClothGuardDoors, OneHalfGoesWithoutTheOther) {
  for (const unsigned chance : {1U, 2U}) {
    const DoorCut door(Guard(), GetParam().distance, chance);
    const DoorCut other(std::nullopt, GetParam().distance, chance);
    EXPECT_NEAR(door.meanAway(), other.meanAway(), 0.01);
  }
}

// A second cut makes another mesh, when the sides of the first are no longer quite at one place. Held to each other
// they drew the half by 9 mm.
TEST(ClothGuardSides, SidesOfAFirstCutAreStillOneAfterASecond) {
  const auto first = [](const btVector3& x) { return x.x() + btScalar(0.0005); };
  const auto second = [](const btVector3& x) { return x.y() + btScalar(0.5); };
  for (const unsigned chance : {1U, 4U}) {
    const DoorCut door(Guard(), first, chance, second);
    const DoorCut other(std::nullopt, first, chance, second);
    EXPECT_NEAR(door.meanAway(), other.meanAway(), 0.003);
  }
}

/// A sheet that was cut a step ago, so that some of its sides still count as one and others have come apart.
struct SavedCut {
  SavedCut() : body(scene.add(hangingPatch())), wet(scene.scene().bullet().world()) {
    wet.setLog({});
    wet.add(body);
    cut(body, [](const btVector3& x) { return x.x() + btScalar(0.3) * (x.y() + btScalar(0.3)); });
    for (int k = 0; k < body.m_nodes.size(); ++k) {
      if (body.m_nodes[k].m_x.y() < btScalar(-0.3)) body.m_nodes[k].m_v.setX(body.m_nodes[k].m_x.x() * 10);
    }
  }
  std::string state() const {
    std::ostringstream stream;
    wet.save(stream);
    return stream.str();
  }
  GuardScene scene;
  btSoftBody& body;
  wetcloth::WetClothWorld wet;
};

TEST(ClothGuardSides, ARestoredRunGoesOnBitForBit) {
  SavedCut first;
  first.scene.step(3);
  const std::string saved = first.state();
  first.scene.step(40);
  SavedCut second;
  second.scene.step(1);  // in which the cut is seen
  std::istringstream stream(saved);
  second.wet.restore(stream);
  EXPECT_EQ(second.state(), saved);
  second.scene.step(40);
  EXPECT_EQ(first.state(), second.state());
}

// Two sheets go through each other, which is told at the start, and when another one is cut; but not while that one
// opens, node by node.
TEST(ClothGuardSides, ThatOpenTellNoCrossingsThatAreKnown) {
  GuardScene scene;
  btSoftBody& body = scene.add(hangingPatch());
  scene.add(levelSheet(9, 0.5, btVector3(2, 0, 0)));
  wetcloth::ClothPatch upright = squarePatch(10);
  upright.origin = btVector3(btScalar(1.77), btScalar(-0.23), btScalar(0.017));
  upright.edgeU = btVector3(btScalar(0.5), 0, 0);
  upright.edgeV = btVector3(0, btScalar(0.5), btScalar(0.01));
  scene.add(upright);
  scene.step(5);
  ASSERT_EQ(scene.scene().messages().size(), 1U);
  cut(body, [](const btVector3& x) { return x.y() + btScalar(0.3) - btScalar(0.4) * x.x(); });
  scene.step(40);
  EXPECT_EQ(scene.scene().messages().size(), 2U);
}

// Before the step that sees the cut.
TEST(ClothGuardSides, AStateThatWasSavedRightAfterACutIsRestored) {
  GuardScene first;
  btSoftBody& sheet = first.add(hangingPatch());
  wetcloth::WetClothWorld wet(first.scene().bullet().world());
  wet.setLog({});
  wet.add(sheet);
  first.step(5);
  const auto distance = [](const btVector3& x) { return x.y() + btScalar(0.32); };
  cut(sheet, distance);
  std::stringstream stream;
  wet.save(stream);
  first.step(20);
  const std::vector<btScalar> places = stateOf(sheet);
  wet.restore(stream);
  first.step(20);
  EXPECT_EQ(stateOf(sheet), places);
}

// A level sheet whose two halves are held and go where they are told.
struct Halves {
  explicit Halves(GuardScene& scene) : body(scene.add(patch())) {
    cut(body, [](const btVector3& x) { return x.x() + btScalar(0.001); });
    middle = body.m_nodes.size() / 2;
  }
  static wetcloth::ClothPatch patch() {
    wetcloth::ClothPatch patch = levelSheet(kNodes, kSide, btVector3(0, 0, 0));
    patch.pinnedEdges = {wetcloth::ClothPatch::Edge::left, wetcloth::ClothPatch::Edge::right};
    return patch;
  }
  // What is on the right is moved so far along x, what is on the left the other way.
  void pull(double way) {
    for (int k = 0; k < body.m_nodes.size(); ++k) {
      btSoftBody::Node& node = body.m_nodes[k];
      if (node.m_im > 0) continue;
      node.m_x.setX(node.m_x.x() + btScalar(node.m_x.x() > 0 ? way : -way));
      node.m_q = node.m_x;
    }
  }
  btSoftBody& body;
  int middle;
};

// What they force when they push the halves into each other is counted apart: here they only close the gap.
TEST(ClothGuardSides, SidesThatHaveComeApartDoNotPassEachOther) {
  GuardScene scene(Guard(), WorldKind::softRigid, btVector3(0, 0, 0));
  Halves halves(scene);
  for (int k = 0; k < 20; ++k) {
    halves.pull(0.05 * kEdge);
    scene.step(1);
  }
  PassageCheck& check = scene.watch();
  ASSERT_EQ(check.meetings(), 0);
  for (int k = 0; k < 30; ++k) {
    halves.pull(-0.05 * kEdge);
    scene.step(1);
  }
  EXPECT_EQ(check.passages(), 0);
  EXPECT_EQ(check.meetings(), 0);
  EXPECT_EQ(scene.totals().forced, 0);
}

// Two halves whose nodes along the seam are there twice; nothing links them.
TEST(ClothGuardSides, MeshWithASeamComesApartAlongIt) {
  GuardScene scene;
  Triangles upper = Triangles::of(hangingPatch());
  const int count = int(upper.places.size());
  Triangles both = upper;
  for (const btVector3& x : upper.places) both.places.push_back(x - btVector3(0, btScalar(kSide), 0));
  for (const auto& face : upper.faces) both.faces.push_back({face[0] + count, face[1] + count, face[2] + count});
  // The last row of the lower half is where the first of the upper one is.
  for (int i = 0; i < kNodes; ++i) {
    both.places[std::size_t(count + kNodes * (kNodes - 1) + i)] = both.places[std::size_t(i)];
  }
  btSoftBody& body = scene.add(both.builder());
  body.m_cfg.kDP = 0;
  for (int i = 0; i < kNodes; ++i) body.setMass(kNodes * (kNodes - 1) + i, 0);
  const std::vector<bool> isHanging = hanging(body);
  ASSERT_EQ(std::count(isHanging.begin(), isHanging.end(), false), count);
  scene.step(20);
  EXPECT_NEAR(double(meanFall(body, isHanging).y()), -9.81 * 20 / 60, 0.005);
  EXPECT_EQ(scene.totals().crossing, 0);
  EXPECT_EQ(scene.totals().stopped, 0);
}

}  // namespace
}  // namespace wetcloth_test::cloth_guard_cuts_test
