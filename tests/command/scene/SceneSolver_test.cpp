// SPDX-License-Identifier: Zlib
// The key "solver" of a scene.

#include "command/scene/SceneReader.h"
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace wetcloth_test::scene_solver_test {
namespace {

using namespace cli;

command::Scene sceneWith(const Json& changes) {
  Json scene = smallScene();
  scene.update(changes);
  const TemporaryDirectory directory;
  return command::readScene(directory.write("scene.json", scene.dump()));
}

TEST(SceneSolver, IsBulletsOwnUnlessTheSceneAsksForAnother) {
  EXPECT_FALSE(sceneWith(Json::object()).clothSolver);
  EXPECT_FALSE(sceneWith({{"solver", "bullet"}}).clothSolver);
  EXPECT_FALSE(sceneWith({{"solver", "bullet"}, {"world", "deformable"}}).clothSolver);
}

TEST(SceneSolver, HasTheDefaultsOfTheLibrary) {
  const wetcloth::ClothSolver::Parameters defaults;
  for (const Json& solver : {Json("wetcloth"), Json::object()}) {
    for (const char* world : {"soft_rigid", "soft_multibody"}) {
      const auto read = sceneWith({{"solver", solver}, {"world", world}}).clothSolver;
      ASSERT_TRUE(read) << solver;
      EXPECT_EQ(read->smallSteps, defaults.smallSteps);
      EXPECT_TRUE(std::isinf(read->stiffness));
    }
  }
}

TEST(SceneSolver, HasNumbers) {
  const auto both = sceneWith({{"solver", {{"small_steps", 20}, {"stiffness_n_m", 1500.5}}}}).clothSolver;
  ASSERT_TRUE(both);
  EXPECT_EQ(both->smallSteps, 20);
  EXPECT_EQ(both->stiffness, 1500.5);
  const auto one = sceneWith({{"solver", {{"small_steps", 1000}}}}).clothSolver;
  ASSERT_TRUE(one);
  EXPECT_EQ(one->smallSteps, 1000);
  EXPECT_TRUE(std::isinf(one->stiffness));
}

}  // namespace
}  // namespace wetcloth_test::scene_solver_test
