// SPDX-License-Identifier: Zlib
// Scenes whose cloths ClothSolver steps.

#include "command/scene/SceneReader.h"
#include "command/scene/SceneWorld.h"
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace wetcloth_test::solver_test {
namespace {

using namespace cli;
using command::SceneWorld;

/// A square metre that hangs from two corners and swings down.
Json hangingScene(const Json& solver = "wetcloth") {
  Json scene = smallScene();
  scene["solver"] = solver;
  scene["cloths"][0]["pins"] = {{"corners", {"top_left", "top_right"}}};
  scene["duration_s"] = 0.5;
  return scene;
}

command::Scene read(const Json& scene) {
  const TemporaryDirectory directory;
  return command::readScene(directory.write("scene.json", scene.dump()));
}

Outcome run(const Json& scene, const std::vector<std::string>& more = {}) {
  const TemporaryDirectory directory;
  std::vector<std::string> words{"run", directory.write("scene.json", scene.dump()), "--precision", testedPrecision()};
  words.insert(words.end(), more.begin(), more.end());
  return runWetcloth(words);
}

bool samePlaces(const SceneWorld& a, const SceneWorld& b) {
  for (std::size_t c = 0; c < a.bodies().size(); ++c) {
    for (int i = 0; i < a.bodies()[c]->m_nodes.size(); ++i) {
      if (!(a.bodies()[c]->m_nodes[i].m_x == b.bodies()[c]->m_nodes[i].m_x)) return false;
    }
  }
  return true;
}

TEST(RunSolver, TheReportSaysWhoStepped) {
  for (const char* world : {"soft_rigid", "soft_multibody"}) {
    Json scene = hangingScene({{"small_steps", 12}});
    scene["world"] = world;
    const TemporaryDirectory directory;
    const Json ours = runCompared(directory.write("scene.json", scene.dump()));
    EXPECT_EQ(ours.at("solver"), "wetcloth");
    EXPECT_EQ(ours.at("small_steps"), 12);
    EXPECT_FALSE(ours.contains("solver_reasons"));
    EXPECT_GT(ours.at("bullet_ms_per_step"), 0);
    scene["solver"] = "bullet";
    const Json bullets = runScene(scene);
    EXPECT_EQ(bullets.at("solver"), "bullet");
    EXPECT_FALSE(bullets.contains("small_steps"));
    EXPECT_FALSE(bullets.contains("solver_reasons"));
    EXPECT_NE(bullets.at("state_hash"), ours.at("state_hash"));
  }
}

TEST(RunSolver, TheSummarySaysWhoStepped) {
  const Outcome outcome = run(hangingScene({{"small_steps", 12}}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("wetcloth, 12 small steps"), std::string::npos) << outcome.out;
}

TEST(RunSolver, AClothThatItDoesNotTakeIsNamedAndMovesAsInBullet) {
  Json scene = hangingScene();
  scene["cloths"].push_back(scene["cloths"][0]);
  scene["cloths"][1]["collisions"] = {"SDF_RS", "VF_SS"};
  const std::string reason =
      "it collides with other soft bodies, and stays with Bullet unless the guard is on for others";
  const Json one = runScene(scene);
  EXPECT_EQ(one.at("solver_reasons"), Json({{"/cloths/1", reason}}));
  scene["cloths"].erase(0);
  const Json ours = runScene(scene);
  EXPECT_EQ(ours.at("solver_reasons"), Json({{"/cloths/0", reason}}));
  scene["solver"] = "bullet";
  EXPECT_EQ(runScene(scene).at("state_hash"), ours.at("state_hash"));
  scene["solver"] = "wetcloth";
  const Outcome outcome = run(scene);
  EXPECT_NE(outcome.out.find("/cloths/0: " + reason), std::string::npos) << outcome.out;
}

// A link between two nodes of mass m that are not pinned needs small steps of at most sqrt(m / k).
TEST(RunSolver, TooFewSmallStepsAreTold) {
  const Outcome enough = run(hangingScene({{"small_steps", 10}, {"stiffness_n_m", 100}}));
  EXPECT_EQ(enough.status, 0);
  EXPECT_EQ(enough.err.find("small steps"), std::string::npos) << enough.err;
  const Outcome few = run(hangingScene({{"small_steps", 1}, {"stiffness_n_m", 1e5}}));
  EXPECT_EQ(few.status, 0);
  EXPECT_NE(few.err.find("small steps"), std::string::npos) << few.err;
}

TEST(RunSolver, SoftLinksStretchFurther) {
  Json scene = hangingScene();
  scene["cloths"][0]["damping"] = 0.02;
  scene["duration_s"] = 3;
  const double hard = runScene(scene).at("max_stretch").get<double>();
  scene["solver"] = {{"stiffness_n_m", 10}};
  const double soft = runScene(scene).at("max_stretch").get<double>();
  EXPECT_LT(hard, 1.02);
  // Two pins carry 0.15 kg and its water: at least 0.7 N each, by at most four links.
  EXPECT_GT(soft, 1.05);
}

TEST(RunSolver, PlainBulletBesideItIsOnBulletsOwn) {
  const command::Scene ours = read(hangingScene());
  const command::Scene bullets = read(hangingScene("bullet"));
  SceneWorld plain(ours, SceneWorld::Kind::plainBullet);
  SceneWorld same(bullets, SceneWorld::Kind::plainBullet);
  SceneWorld wet(ours);
  SceneWorld wetInBullet(bullets);
  for (int i = 0; i < 30; ++i) {
    for (SceneWorld* world : {&plain, &same, &wet, &wetInBullet}) world->step();
  }
  EXPECT_TRUE(samePlaces(plain, same));
  EXPECT_FALSE(samePlaces(wet, wetInBullet));
  EXPECT_EQ(plain.clothSolver(), nullptr);
  ASSERT_NE(wet.clothSolver(), nullptr);
  EXPECT_EQ(wetInBullet.clothSolver(), nullptr);
}

TEST(RunSolver, SameSceneSameHash) {
  const Json scene = hangingScene();
  EXPECT_EQ(runScene(scene).at("state_hash"), runScene(scene).at("state_hash"));
}

TEST(RunSolver, AResumedRunEndsAsOneThatWasNot) {
  for (const char* name : {"hanging_towel", "dip_and_lift", "rain_on_umbrella_cloth"}) {
    Json scene = readJson(sceneFile(name));
    scene["solver"] = "wetcloth";
    const TemporaryDirectory directory;
    const std::string file = directory.write("scene.json", scene.dump());
    const std::string state = directory.path("run.state");
    const Json whole = runScene(file, {"--duration", "0.4", "--checkpoint", state, "--every", "17"});
    const Json resumed = runScene(file, {"--duration", "0.4", "--resume", state});
    EXPECT_EQ(resumed.at("state_hash"), whole.at("state_hash")) << name;
  }
}

TEST(RunSolver, TheOptionOverrulesTheScene) {
  const std::string onBullets = runScene(hangingScene("bullet")).at("state_hash");
  const std::string onOurs = runScene(hangingScene("wetcloth")).at("state_hash");
  const auto hashOf = [](const Json& scene, const char* solver) {
    const Json result = runScene(scene, {"--solver", solver});
    EXPECT_EQ(result.at("solver"), solver);
    return result.at("state_hash").get<std::string>();
  };
  EXPECT_EQ(hashOf(hangingScene("bullet"), "wetcloth"), onOurs);
  EXPECT_EQ(hashOf(hangingScene("wetcloth"), "bullet"), onBullets);
  EXPECT_EQ(hashOf(hangingScene({{"small_steps", 20}}), "bullet"), onBullets);
  const Json numbers = {{"small_steps", 20}, {"stiffness_n_m", 50}};
  EXPECT_EQ(hashOf(hangingScene(numbers), "wetcloth"), runScene(hangingScene(numbers)).at("state_hash"));
}

TEST(RunSolver, TheOptionIsRefusedInTheDeformableWorld) {
  Json scene = hangingScene("bullet");
  scene["world"] = "deformable";
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", scene.dump());
  const std::string page = directory.path("run.html");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"run", file},
                                                {"cost", file},
                                                {"render", file, "--out", page},
                                                {"export", file, "--format", "html", "--out", page}}) {
    std::vector<std::string> arguments = words;
    arguments.insert(arguments.end(), {"--solver", "wetcloth", "--precision", testedPrecision()});
    expectRefusal(runWetcloth(arguments), {"--solver = \"wetcloth\"", "\"bullet\"", "deformable"});
  }
  EXPECT_EQ(run(scene, {"--solver", "bullet"}).status, 0);
}

TEST(RunSolver, AnotherWordIsRefused) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", smallScene().dump());
  for (const char* command : {"run", "cost", "view"}) {
    expectRefusal(runWetcloth({command, file, "--solver", "wetcloht"}), {"--solver", "\"wetcloht\"", "\"wetcloth\""});
  }
  expectRefusal(runWetcloth({"fall", "--solver", "bulet"}), {"--solver", "\"bulet\"", "\"bullet\""});
}

TEST(RunSolver, APageShowsWhatTheSolverDid) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", hangingScene("bullet").dump());
  const auto pageOf = [&](const std::vector<std::string>& more) {
    const std::string page = directory.path("run.html");
    std::vector<std::string> words{"render", file, "--out", page, "--precision", testedPrecision()};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(runWetcloth(words).status, 0);
    std::ifstream stream(page, std::ios::binary);
    return std::string((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  };
  const std::string onBullets = pageOf({});
  EXPECT_EQ(pageOf({"--solver", "bullet"}), onBullets);
  EXPECT_NE(pageOf({"--solver", "wetcloth"}), onBullets);
}

TEST(RunSolver, ACheckpointOfTheOtherIsRefused) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", hangingScene("bullet").dump());
  const std::string state = directory.path("run.state");
  runScene(file, {"--checkpoint", state, "--every", "5"});
  expectRefusal(runWetcloth({"run", file, "--solver", "wetcloth", "--resume", state, "--precision", testedPrecision()}),
                {"--resume", state, "solver", "\"bullet\"", "\"wetcloth\""});
}

// Errors were measured on Bullet's solver: they say nothing about the other one.
TEST(RunSolver, NoErrorsAreExpectedOfWhatWasNotMeasured) {
  const Json bullets = runScene(hangingScene("bullet"), {"--quality", "draft"});
  EXPECT_TRUE(bullets.contains("expected_errors"));
  const Json ours = runScene(hangingScene(), {"--quality", "draft"});
  EXPECT_EQ(ours.at("substeps"), bullets.at("substeps"));
  EXPECT_FALSE(ours.contains("expected_errors"));
  EXPECT_EQ(run(hangingScene()).out.find("measured error"), std::string::npos);
  expectRefusal(run(hangingScene(), {"--error-budget", "0.5", "--json", "-"}),
                {"--error-budget = 0.5", "solver wetcloth"});
}

TEST(RunSolver, AGuardTellsWhatStoodInBodies) {
  Json scene = hangingScene({{"guard", {{"bodies", true}}}});
  EXPECT_TRUE(read(scene).clothSolver->guard->bodies);
  EXPECT_EQ(runScene(scene).at("guard").at("inside"), 0);
  scene["solver"]["guard"]["bodies"] = false;
  EXPECT_FALSE(runScene(scene).at("guard").contains("inside"));
  scene["solver"]["guard"]["bodies"] = 1;
  EXPECT_NE(run(scene).err.find("/solver/guard/bodies"), std::string::npos);
}

TEST(RunSolver, AGuardUntanglesByChoice) {
  Json scene = hangingScene({{"guard", Json::object()}});
  EXPECT_FALSE(read(scene).clothSolver->guard->untangle);
  scene["solver"]["guard"]["untangle"] = true;
  EXPECT_TRUE(read(scene).clothSolver->guard->untangle);
  scene["solver"]["guard"]["untangle"] = "yes";
  EXPECT_NE(run(scene).err.find("/solver/guard/untangle"), std::string::npos);
}

}  // namespace
}  // namespace wetcloth_test::solver_test
