// SPDX-License-Identifier: Zlib
// Cloths, and the guard itself, come and go between steps.
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/solver/GuardScene.h"
#include "tests/support/Rejection.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <utility>

namespace wetcloth_test::cloth_guard_life_test {
namespace {

TEST(ClothGuardLife, ClothsComeAndGo) {
  GuardScene scene;
  scene.addFloor();
  scene.add(wavySheet(10, 0.6));
  scene.watch();
  scene.step(20);
  EXPECT_EQ(scene.passages(), 0);
  for (int turn = 0; turn < 3; ++turn) {
    scene.add(wavySheet(9 + turn, 0.5, btVector3(0, btScalar(0.7), btScalar(0.02 * turn))));
    ASSERT_EQ(scene.watch().meetings(), 0);
    scene.step(40);
    EXPECT_EQ(scene.passages(), 0) << turn;
    scene.forgetLast();
    scene.watch();
    scene.step(5);
    EXPECT_EQ(scene.passages(), 0) << turn;
  }
  EXPECT_EQ(scene.totals().meeting, 0);
  EXPECT_EQ(scene.totals().halts, 0);
}

// What the application has switched off is not stepped: it lies where it is, in mid-air, and holds another one up.
TEST(ClothGuardLife, AClothThatIsNotSimulatedIsNotPassed) {
  GuardScene scene;
  btSoftBody& sleeper = scene.add(levelSheet(9, 0.8, btVector3(0, 0, 0)));
  btSoftBody& body = scene.add(levelSheet(7, 0.4, btVector3(btScalar(0.01), btScalar(0.1), btScalar(0.02))));
  sleeper.forceActivationState(DISABLE_SIMULATION);
  scene.step(90);
  for (int k = 0; k < sleeper.m_nodes.size(); ++k) EXPECT_EQ(sleeper.m_nodes[k].m_x.y(), 0) << k;
  for (int k = 0; k < body.m_nodes.size(); ++k) {
    EXPECT_GT(body.m_nodes[k].m_x.y(), 0) << k;
    EXPECT_LT(body.m_nodes[k].m_x.y(), 0.01) << k;
  }
  EXPECT_LT(rmsSpeed(body), 0.02);
  EXPECT_EQ(scene.totals().forced, 0);
  EXPECT_EQ(scene.totals().halts, 0);
}

void setGuard(GuardScene& scene, std::optional<Guard> guard) {
  wetcloth::ClothSolver::Parameters parameters = scene.solver().parameters();
  parameters.guard = guard;
  scene.solver().setParameters(parameters);
}

TEST(ClothGuardLife, IsSwitchedOnAndOffBetweenSteps) {
  GuardScene scene;
  scene.addFloor();
  scene.add(wavySheet(10, 0.6));
  btSoftBody& body = scene.add(wavySheet(11, 0.6, btVector3(btScalar(0.03), btScalar(0.07), btScalar(0.04))));
  scene.watch();
  scene.step(3);
  setGuard(scene, std::nullopt);
  const long long looks = scene.totals().looks;
  scene.step(2);
  EXPECT_EQ(scene.totals().looks, looks);
  setGuard(scene, Guard());
  scene.step(30);
  EXPECT_GT(scene.totals().looks, looks);
  EXPECT_GT(scene.totals().pairs, 0);
  EXPECT_EQ(scene.passages(), 0);
  EXPECT_EQ(scene.totals().meeting, 0);

  setGuard(scene, std::nullopt);
  scene.step(20);
  EXPECT_GT(scene.passages(), 10);
  setGuard(scene, Guard());
  scene.step(30);
  EXPECT_EQ(scene.totals().halts, 0);
  EXPECT_TRUE(isFinite(body));
  EXPECT_LT(largestSpeed(body), 5);
}

TEST(ClothGuardLife, CountsFromAReset) {
  GuardScene scene;
  scene.add(wavySheet(8, 0.5));
  scene.add(wavySheet(8, 0.5, btVector3(0, btScalar(0.05), btScalar(0.001))));
  EXPECT_EQ(scene.totals().looks, 0);
  scene.step(2);
  EXPECT_GT(scene.totals().looks, 0);
  EXPECT_GT(scene.totals().candidates, 0);
  EXPECT_GT(scene.totals().pairs, 0);
  EXPECT_GE(scene.totals().candidates, scene.totals().pairs);
  scene.solver().resetGuardTotals();
  const wetcloth::ClothSolver::GuardTotals totals = scene.totals();
  EXPECT_EQ(
      totals.looks + totals.candidates + totals.pairs + totals.stopped + totals.halts + totals.forced + totals.meeting,
      0);
}

// The same with its nodes in an order in which there are no rows.
BodyBuilder shuffled(const BodyBuilder& builder) {
  return [builder](btSoftBodyWorldInfo& info) {
    const std::unique_ptr<btSoftBody> body = builder(info);
    Triangles mesh;
    for (int k = 0; k < body->m_nodes.size(); ++k) mesh.places.push_back(body->m_nodes[k].m_x);
    for (int k = 0; k < body->m_faces.size(); ++k) {
      const btSoftBody::Face& face = body->m_faces[k];
      mesh.faces.push_back({numberOf(*body, face.m_n[0]), numberOf(*body, face.m_n[1]), numberOf(*body, face.m_n[2])});
    }
    std::mt19937 random(5);
    return mesh.shuffled(random).builder()(info);
  };
}

// A sheet that falls onto another one, in the middle of it.
struct Saved {
  explicit Saved(double away, bool isShuffled = false) {
    scene.addFloor(0, away);
    const BodyBuilder sheets[2] = {
        wavySheet(9, 0.6, btVector3(btScalar(away), btScalar(0.05), 0)),
        wavySheet(10, 0.6, btVector3(btScalar(away + 0.03), btScalar(0.07), btScalar(0.04)))};
    for (int k = 0; k < 2; ++k) bodies[k] = &scene.add(isShuffled ? shuffled(sheets[k]) : sheets[k]);
    world = std::make_unique<wetcloth::WetClothWorld>(scene.scene().bullet().world());
    world->setLog({});
    for (btSoftBody* body : bodies) world->add(*body);
  }
  std::string state() const {
    std::ostringstream stream;
    world->save(stream);
    return stream.str();
  }
  std::vector<btScalar> places() const {
    std::vector<btScalar> all = stateOf(*bodies[0]);
    const std::vector<btScalar> more = stateOf(*bodies[1]);
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  GuardScene scene;
  btSoftBody* bodies[2];
  std::unique_ptr<wetcloth::WetClothWorld> world;
};

TEST(ClothGuardLife, ARestoredRunGoesOnBitForBit) {
  for (const auto& [away, isShuffled] : {std::pair(0.0, false), std::pair(3000.0, false), std::pair(0.0, true)}) {
    Saved first(away, isShuffled);
    first.scene.step(33);
    ASSERT_GT(first.scene.totals().pairs, 0) << "they touch";
    const std::string saved = first.state();
    first.scene.step(30);
    Saved second(away, isShuffled);
    std::istringstream stream(saved);
    second.world->restore(stream);
    EXPECT_EQ(second.state(), saved);
    second.scene.step(30);
    EXPECT_TRUE(sameBits(first.places(), second.places())) << away;
    EXPECT_EQ(first.state(), second.state()) << away;
  }
}

TEST(ClothGuardLife, TheSameSceneMovesAlikeBitForBit) {
  Saved first(0);
  Saved second(0);
  first.scene.step(60);
  second.scene.step(60);
  EXPECT_TRUE(sameBits(first.places(), second.places()));
}

TEST(ClothGuardLife, RefusesBadParameters) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Bad {
    Guard guard;
    const char* field;
    const char* value;
  };
  const Bad bads[] = {{{-1, true, true, 5, 0.3}, "thickness", "-1"},  {{nan, true, true, 5, 0.3}, "thickness", "nan"},
                      {{0.002, true, true, 0, 0.3}, "every", "0"},    {{0.002, true, true, 101, 0.3}, "every", "101"},
                      {{0.002, true, true, 5, -1}, "friction", "-1"}, {{0.002, true, true, 5, nan}, "friction", "nan"}};
  for (const Bad& bad : bads) {
    const std::string made = rejection([&] { wetcloth::ClothSolver solver(guardedBy(bad.guard)); });
    EXPECT_NE(made.find(bad.field), std::string::npos) << made;
    EXPECT_NE(made.find(bad.value), std::string::npos) << made;
    wetcloth::ClothSolver solver;
    const std::string set = rejection([&] { solver.setParameters(guardedBy(bad.guard)); });
    EXPECT_EQ(set, made);
    EXPECT_FALSE(solver.parameters().guard.has_value()) << "nothing has changed";
  }
  EXPECT_NO_THROW(wetcloth::ClothSolver(guardedBy(Guard{0, false, false, 1, 0})));
  EXPECT_NO_THROW(wetcloth::ClothSolver(guardedBy(Guard{10, true, true, 100, 1000})));
}

}  // namespace
}  // namespace wetcloth_test::cloth_guard_life_test
