// SPDX-License-Identifier: Zlib
#include "tests/command/Command.h"

#include "command/scene/EffectCatalogue.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

// What a machine takes is never asserted here, only what is said about it.

namespace wetcloth_test::cost_test {
namespace {

using namespace cli;

Json costOf(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{"cost", "--json", "-", "--precision", testedPrecision()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const Outcome outcome = runWetcloth(words);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.status == 0 ? Json::parse(outcome.out) : Json();
}

Json costOfScene(const Json& scene, const std::string& steps = "4") {
  const TemporaryDirectory directory;
  return costOf({directory.write("scene.json", scene.dump()), "--steps", steps});
}

std::vector<std::string> namesIn(const Json& result) {
  std::vector<std::string> names;
  for (const Json& effect : result.at("effects")) names.push_back(effect.at("name"));
  return names;
}

void expectNumbers(const Json& object, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) EXPECT_TRUE(object.at(key).is_number()) << key;
}

/// The share of a step is the time per node, over Bullet's.
void expectConsistent(const Json& result) {
  const double bullet = result.at("baseline_ns_per_node");
  EXPECT_GT(bullet, 0);
  for (const Json& effect : result.at("effects")) {
    expectNumbers(effect, {"ns_per_node", "percent_of_step", "noise_percent", "mean_ns_per_node",
                           "mean_noise_ns_per_node", "whole_step_percent", "whole_step_noise_percent"});
    const double time = effect.at("ns_per_node");
    const double percent = effect.at("percent_of_step");
    EXPECT_GE(time, 0);
    // The guard is in the solver's step: its noise is the whole step's, not that of the effects' own part.
    if (effect.at("name") != "guard") {
      EXPECT_GE(effect.at("noise_percent").get<double>(), result.at("noise_percent").get<double>());
    }
    EXPECT_NEAR(percent, 100 * time / bullet, 1e-9 * (1 + percent));
    EXPECT_EQ(effect.at("below_noise").get<bool>(), percent <= effect.at("noise_percent").get<double>());
  }
}

TEST(Cost, WithoutASceneEveryEffectThatASceneCanHave) {
  const Json result = costOf({"--steps", "1"});
  EXPECT_EQ(result.at("nodes"), 64 * 64);
  EXPECT_EQ(result.at("world"), "soft_rigid");
  EXPECT_EQ(result.at("steps"), 1);
  const std::vector<std::string> names = namesIn(result);
  const std::vector<std::string> keys = command::effectKeys(command::effectCatalogue()).keys;
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()), std::set<std::string>(keys.begin(), keys.end()));
  expectConsistent(result);
}

TEST(Cost, HelpEndsWithStatusZero) {
  const Outcome outcome = runWetcloth({"cost", "--help"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.out.find("--steps"), std::string::npos);
  EXPECT_EQ(outcome.err, "");
}

TEST(Cost, SaysAllItsKeys) {
  const Json result = costOfScene(smallScene());
  expectNumbers(result, {"nodes", "steps", "dt", "iterations", "worlds", "baseline_ns_per_node", "noise_percent",
                         "no_effects_ratio", "no_effects_percent", "no_effects_noise_percent",
                         "all_effects_ns_per_node", "all_effects_percent", "all_effects_whole_step_percent"});
  EXPECT_EQ(result.at("scene"), "small");
  EXPECT_EQ(result.at("precision"), testedPrecision());
  EXPECT_EQ(result.at("nodes"), 20);
  EXPECT_EQ(result.at("steps"), 4);
  EXPECT_DOUBLE_EQ(result.at("dt").get<double>(), 0.0166667 / 4);  // Bullet's own step, a substep of the scene
  EXPECT_EQ(result.at("worlds"), 4 + 2);
  EXPECT_GE(result.at("no_effects_percent"), 0);
  EXPECT_EQ(namesIn(result), (std::vector<std::string>{"absorption", "wind"}));
  expectConsistent(result);
}

TEST(Cost, ASceneWithoutEffectsHasAnEmptyList) {
  Json scene = smallScene();
  scene["cloths"][0].erase("effects");
  const Json result = costOfScene(scene);
  EXPECT_EQ(result.at("effects"), Json::array());
  EXPECT_EQ(result.at("no_effects_same_state"), true);
  EXPECT_EQ(result.at("worlds"), 4);
}

TEST(Cost, WithoutEffectsAClothGoesWhereBulletTakesIt) {
  for (const char* world : {"soft_rigid", "soft_multibody", "deformable"}) {
    Json scene = smallScene();
    scene["world"] = world;
    scene["cloths"][0]["initial_saturation"] = 0.5;
    scene["cloths"][0]["effects"]["hooke_springs"] = Json::object();
    EXPECT_EQ(costOfScene(scene, "40").at("no_effects_same_state"), true) << world;
  }
}

TEST(Cost, EffectsOfSeveralClothsAreCountedOnceWithAllNodes) {
  Json scene = smallScene();
  Json second = scene["cloths"][0];
  second["patch"]["origin_m"] = {0, 3, 0};
  second["patch"]["columns"] = 3;
  second["effects"] = {{"wind", {{"velocity_m_s", {1, 0, 0}}}}, {"hooke_springs", Json::object()}};
  scene["cloths"].push_back(second);
  const Json result = costOfScene(scene);
  EXPECT_EQ(result.at("nodes"), 20 + 12);
  EXPECT_EQ(namesIn(result), (std::vector<std::string>{"absorption", "wind", "hooke_springs"}));
  expectConsistent(result);
}

TEST(Cost, PrintsATableAndWritesAFile) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.json", smallScene().dump());
  const Outcome outcome = runWetcloth(
      {"cost", scene, "--steps", "4", "--json", directory.path("cost.json"), "--precision", testedPrecision()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* word : {"small", "plain Bullet", "no effects", "absorption", "wind", "noise"}) {
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word << " in: " << outcome.out;
  }
  EXPECT_EQ(readJson(directory.path("cost.json")).at("effects").size(), 2u);
}

TEST(Cost, RefusesBadInput) {
  const TemporaryDirectory directory;
  const std::string missing = directory.path("missing.json");
  expectRefusal(runWetcloth({"cost", missing}), {missing, "no such file"});
  const std::string broken = directory.write("broken.json", "{");
  expectRefusal(runWetcloth({"cost", broken}), {broken, "is not JSON"});
  Json scene = smallScene();
  scene["cloths"][0]["effects"]["absorbtion"] = Json::object();
  const std::string typo = directory.write("typo.json", scene.dump());
  expectRefusal(runWetcloth({"cost", typo}), {typo, "/cloths/0/effects/absorbtion", "\"absorption\""});
  const std::string good = directory.write("good.json", smallScene().dump());
  expectRefusal(runWetcloth({"cost", good, "--steps", "0"}), {"--steps = 0", "1 to 100000"});
  expectRefusal(runWetcloth({"cost", good, "--steps", "many"}), {"--steps"});
  expectRefusal(runWetcloth({"cost", good, "--precision", "float16"}), {"--precision", "float32"});
  expectRefusal(runWetcloth({"cost", good, good}), {"wetcloth: "});
  expectRefusal(runWetcloth({"cost", good, "--json", directory.path("no/cost.json"), "--precision", testedPrecision()}),
                {"--json"});
}

TEST(Cost, AStateThatBlewUpIsARunThatFailedAndLeavesNoFile) {
  Json scene = smallScene();
  scene["cloths"][0]["effects"]["wind"] = {{"velocity_m_s", {0, 1e5, 1e5}}, {"integration", "explicit_euler"}};
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", scene.dump());
  const Outcome outcome =
      runWetcloth({"cost", file, "--json", directory.path("cost.json"), "--precision", testedPrecision()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err.rfind(file + ": ", 0), 0u) << outcome.err;
  EXPECT_NE(outcome.err.find("with all effects the state became non-finite"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(directory.path("cost.json")));
}

TEST(Cost, AWorldThatFailsWithoutAnEffectEndsTheMeasurement) {
  Json scene = smallScene();
  scene.erase("colliders");
  scene["gravity_m_s2"] = {0, -1e8, 0};  // only the air keeps the cloth from being 1e8 m away in 1.4 s, 340 steps
  const Json result = costOfScene(scene, "500");
  EXPECT_LT(result.at("steps"), 500);
  EXPECT_EQ(result.at("stopped").get<std::string>().rfind("in plain Bullet the cloth blew up", 0), 0u);
  EXPECT_EQ(namesIn(result), (std::vector<std::string>{"absorption", "wind"}));
  expectConsistent(result);
}

TEST(Cost, TheGuardIsOneOfWhatASceneCallsFor) {
  Json scene = smallScene();
  scene["solver"] = {{"guard", Json::object()}};
  const Json result = costOfScene(scene);
  EXPECT_EQ(namesIn(result), (std::vector<std::string>{"absorption", "wind", "guard"}));
  EXPECT_EQ(result.at("worlds"), 4 + 3);
  expectConsistent(result);
  const Json& guard = result.at("effects").back();
  EXPECT_EQ(guard.at("noise_percent"), guard.at("whole_step_noise_percent"))
      << "it is in the solver's part of the step";
  scene["cloths"][0].erase("effects");
  EXPECT_EQ(namesIn(costOfScene(scene)), (std::vector<std::string>{"guard"}));
}

TEST(Cost, OnClothSolverBesidePlainBulletOnItsOwn) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", smallScene().dump());
  const Json bullets = costOf({file, "--steps", "4"});
  const Json ours = costOf({file, "--steps", "4", "--solver", "wetcloth"});
  EXPECT_EQ(bullets.at("solver"), "bullet");
  EXPECT_EQ(bullets.at("no_effects_same_state"), true);
  EXPECT_EQ(ours.at("solver"), "wetcloth");
  EXPECT_FALSE(ours.contains("no_effects_same_state"));  // a cloth on another solver is in another state
  expectConsistent(ours);
  EXPECT_EQ(namesIn(ours), namesIn(bullets));
  const Outcome text = runWetcloth({"cost", file, "--steps", "4", "--solver", "wetcloth"});
  EXPECT_EQ(text.out.find("ANOTHER STATE"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("solver wetcloth"), std::string::npos) << text.out;
}

}  // namespace
}  // namespace wetcloth_test::cost_test
