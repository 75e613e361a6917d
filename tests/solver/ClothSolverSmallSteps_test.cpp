// SPDX-License-Identifier: Zlib
// How many small steps a cloth has, how many it needs, and who may look at them.
#include "bullet_wetcloth/solver/ClothSolver.h"

#include "tests/solver/SolverScene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace wetcloth_test::cloth_solver_small_steps_test {
namespace {

using wetcloth::ClothSolver;

TEST(ClothSolverSmallSteps, TellsHowManySmallStepsAStiffClothNeeds) {
  const double mass = 0.002;
  const double stiffness = 5000;
  SolverScene scene(WorldKind::softRigid, kEarthGravity, smallSteps(4, stiffness));
  btSoftBody& rope = scene.add(hangingRope(5, 0.1, mass));
  scene.step(2);
  const int needed = scene.solver().smallStepsFor(rope);
  EXPECT_EQ(needed, int(std::ceil(std::sqrt(stiffness / mass) / 60)));  // h^2 = m / k
  ASSERT_EQ(scene.messages().size(), 1u);
  EXPECT_NE(scene.messages().front().find(std::to_string(needed)), std::string::npos);
}

TEST(ClothSolverSmallSteps, ShowsEachSmallStep) {
  SolverScene scene(WorldKind::softRigid, kEarthGravity, smallSteps(7));
  btSoftBody& body = scene.add(hangingPatch(5));
  std::vector<int> indices;
  btVector3 last(0, 0, 0);
  scene.solver().setSmallStepCallback([&](const wetcloth::ClothSolver::SmallStepView& view) {
    EXPECT_EQ(&view.body, &body);
    indices.push_back(view.index);
    last = view.position(2);
  });
  scene.step(1);
  EXPECT_EQ(indices, (std::vector<int>{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_LT(double((last - body.m_nodes[2].m_x).length()), 1e-6);
}

TEST(ClothSolverSmallSteps, ACallbackThatThrowsIsNotCalledAgain) {
  for (const bool isGuarded : {false, true}) {
    ClothSolver::Parameters parameters = smallSteps(7);
    if (isGuarded) parameters.guard.emplace();
    SolverScene scene(WorldKind::softRigid, kEarthGravity, parameters);
    SolverScene silent(WorldKind::softRigid, kEarthGravity, parameters);
    btSoftBody& body = scene.add(hangingPatch(5));
    btSoftBody& undisturbed = silent.add(hangingPatch(5));
    int calls = 0;
    scene.solver().setSmallStepCallback([&](const ClothSolver::SmallStepView&) {
      if (++calls == 3) throw std::runtime_error("no room");
    });
    EXPECT_NO_THROW(scene.step(2));
    EXPECT_EQ(calls, 3);
    ASSERT_EQ(scene.messages().size(), 1u);
    EXPECT_NE(scene.messages().front().find("no room"), std::string::npos) << scene.messages().front();
    silent.step(2);
    for (int i = 0; i < body.m_nodes.size(); ++i) EXPECT_EQ(body.m_nodes[i].m_x, undisturbed.m_nodes[i].m_x) << i;
  }
}

TEST(ClothSolverSmallSteps, ALogThatThrowsDoesNotStopTheStep) {
  SolverScene scene(WorldKind::softRigid, kEarthGravity, smallSteps(7));
  scene.add(hangingPatch(5)).m_nodes[7].m_x.setX(std::numeric_limits<btScalar>::quiet_NaN());
  scene.solver().setLog([](const std::string&) { throw std::runtime_error("no room"); });
  EXPECT_NO_THROW(scene.step(2));
}

// They are about as long in any of Bullet's steps.
TEST(ClothSolverSmallSteps, AShorterStepHasFewerSmallSteps) {
  SolverScene scene;
  btSoftBody& body = scene.add(hangingPatch(4));
  scene.step(1);
  const auto count = [&](double dt) { return scene.solver().smallStepsIn(body, dt); };
  EXPECT_EQ(count(1.0 / 60), 10);
  EXPECT_EQ(count(1.0 / 30), 20);
  EXPECT_EQ(count(1.0 / 120), 5);
  EXPECT_EQ(count(1.0 / 240), 3);
  EXPECT_EQ(count(1.0 / 1000), 1);
  scene.step(1, 1.0 / 1000);
  EXPECT_EQ(count(1.0 / 1000), 2) << "the second step of that length: half as long as those before";
  EXPECT_EQ(count(1.0 / 2000), 1);
  scene.step(3, 1.0 / 1000);
  EXPECT_EQ(count(1.0 / 1000), 4) << "the least";
  EXPECT_EQ(count(100), 1000);
  body.m_cfg.timescale = 2;
  EXPECT_EQ(count(1.0 / 60), 20);
  body.m_cfg.viterations = 1;
  scene.step(1);
  EXPECT_EQ(count(1.0 / 60), 0) << "Bullet's";
}

}  // namespace
}  // namespace wetcloth_test::cloth_solver_small_steps_test
