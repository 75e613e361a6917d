// SPDX-License-Identifier: Zlib
// A run that exploded is not a success; and what says nothing of its springs does not explode.

#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace wetcloth_test::command_blow_up_test {
namespace {

using namespace cli;

const std::string kDefaultSprings = WETCLOTH_SOURCE_DIR "/tests/data/meshes/default_springs.json";

Json exploding() {
  Json scene = readJson(kDefaultSprings);
  scene["cloths"][0]["spring_stiffness_n_m"] = 100;
  return scene;
}

// In every command that steps a scene; of `view`, which has a window, tests/command/viewer/LiveScene_test.cpp.
TEST(BlowUp, OfARunIsAFailureThatNamesNodeTimeAndRemedy) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", exploding().dump());
  const std::string out = directory.path("out");
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"run", file, "--json", "-"},
                                             {"export", file, "--format", "ply", "--out", out},
                                             {"render", file, "--out", out + ".html"},
                                             {"cost", file, "--steps", "100", "--json", out + ".json"}}) {
    SCOPED_TRACE(command.front());
    const Outcome outcome = runWetcloth(command);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const char* word : {"/cloths/0: node ", "blew up", "t = ", "substeps", "spring_stiffness_n_m"}) {
      EXPECT_NE(outcome.err.find(word), std::string::npos) << word << ": " << outcome.err;
    }
    for (const char* left : {"", ".html", ".json"}) EXPECT_FALSE(std::filesystem::exists(out + left)) << left;
  }
}

TEST(BlowUp, DoesNotHappenToTheDefaultsAtAnyMeshAndStep) {
  for (const int nodes : {3, 8, 33}) {
    for (const int substeps : {1, 4}) {
      Json scene = readJson(kDefaultSprings);
      scene["substeps"] = substeps;
      scene["cloths"][0]["patch"]["columns"] = scene["cloths"][0]["patch"]["rows"] = nodes;
      const Json result = runScene(scene);
      EXPECT_LT(result.at("max_speed").get<double>(), 9.81) << nodes << ' ' << substeps;  // than in a free fall
      EXPECT_LE(result.at("springs_n_m").at(0).get<double>(), 100);
      EXPECT_LT(result.at("max_stretch").get<double>(), substeps == 4 ? 20 : 200) << nodes;
    }
  }
}

TEST(BlowUp, IsNotWhatFallsFarIsBlownOrHangsLong) {
  Json falling = readJson(kDefaultSprings);
  falling["cloths"][0].erase("pins");
  falling["cloths"][0]["patch"]["columns"] = falling["cloths"][0]["patch"]["rows"] = 8;
  falling["duration_s"] = 20;
  EXPECT_GT(runScene(falling).at("max_speed").get<double>(), 100);
  Json blown = smallScene();
  blown["cloths"][0]["effects"] = {{"wind", {{"velocity_m_s", {0, 0, 150}}}}};
  runScene(blown);
  Json soft = smallScene();
  soft["cloths"][0]["effects"] = {{"hooke_springs", {{"stiffness_n_m", 0.2}, {"bending_stiffness_n_m", 0.01}}}};
  soft["duration_s"] = 3;
  EXPECT_GT(runScene(soft).at("max_stretch").get<double>(), 3);
}

TEST(BlowUp, IsWhatNoClothSurvives) {
  const auto expectFailure = [](const Json& scene, const char* why) {
    const TemporaryDirectory directory;
    const Outcome outcome = runWetcloth({"run", directory.write("scene.json", scene.dump())});
    EXPECT_EQ(outcome.status, 1) << why;
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
  };
  Json falling = smallScene();
  falling.erase("colliders");
  falling["cloths"][0].erase("effects");
  falling["gravity_m_s2"] = {0, -1e8, 0};
  falling["duration_s"] = 2;  // of which 1.4 are 1e8 m
  expectFailure(falling, "m away, farther than Bullet bears");
  Json torn = smallScene();
  torn["cloths"][0]["pins"] = {{"edges", {"top"}}};
  torn["cloths"][0]["patch"]["columns"] = torn["cloths"][0]["patch"]["rows"] = 25;
  torn["cloths"][0]["effects"] = {{"wind", {{"velocity_m_s", {0, 9e5, 0}}}}};
  expectFailure(torn, "times as long as at rest");
}

TEST(BlowUp, ARunMayLastLongerThanAnHour) {
  Json scene = smallScene();
  scene["duration_s"] = 36000;
  scene["step_s"] = 1;
  scene["gravity_m_s2"] = {0, 0, 0};
  scene["substeps"] = 1;
  const TemporaryDirectory directory;
  EXPECT_EQ(runWetcloth({"validate", directory.write("scene.json", scene.dump())}).status, 0);
  scene["duration_s"] = 1e20;
  expectRefusal(runWetcloth({"validate", directory.write("scene.json", scene.dump())}), {"/duration_s", "2e9 steps"});
}

}  // namespace
}  // namespace wetcloth_test::command_blow_up_test
