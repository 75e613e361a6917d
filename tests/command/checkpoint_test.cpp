// SPDX-License-Identifier: Zlib
// `wetcloth run --checkpoint` and `--resume`: a run that is cut short and goes on ends as if nothing had been.

#include "command/run/Checkpoint.h"
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace wetcloth_test::checkpoint_test {
namespace {

using namespace cli;

/// All that does not depend on how fast the machine was.
Json withoutTimes(Json report) {
  report.erase("wall_ms_per_step");
  report.erase("bullet_ms_per_step");
  return report;
}

std::string readBytes(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return std::string((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
}

#ifndef _WIN32
/// Stopped by force after so many seconds, if it has not come to its end.
Outcome runUntilKilled(double seconds, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"timeout", "--signal=KILL", std::to_string(seconds), WETCLOTH_COMMAND});
  return runProgram(arguments);
}
#endif

class Checkpoint : public testing::Test {
 protected:
  std::vector<std::string> runArguments(const std::string& scene, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"run", scene, "--no-comparison", "--precision", testedPrecision(), "--json", "-"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::string file() const { return m_directory.path("run.state"); }

  TemporaryDirectory m_directory;
};

// With every effect that the scenes have, with pins that move and turn, and in the worlds that they use.
TEST_F(Checkpoint, AResumedRunEndsAsOneThatWasNot) {
  for (const char* name : {"hanging_towel", "towel_under_hose", "dip_and_lift", "towel_on_wet_floor", "audit_twist",
                           "heap", "curtain_deformable", "wet_shirt_on_sphere"}) {
    SCOPED_TRACE(name);
    const std::string scene = sceneFile(name);
    const std::vector<std::string> length = {"--duration", "0.4"};
    const Json whole = runScene(scene, {"--duration", "0.4", "--checkpoint", file(), "--every", "17"});
    const Json resumed = runCompared(scene, {"--duration", "0.4", "--resume", file()});
    EXPECT_GT(resumed.at("bullet_ms_per_step"), 0);
    EXPECT_EQ(withoutTimes(resumed), withoutTimes(whole));
    EXPECT_EQ(withoutTimes(runScene(scene, length)), withoutTimes(whole));
  }
}

#ifndef _WIN32
// However short the time between two kills is at first, it grows until one step from checkpoint to checkpoint fits in.
TEST_F(Checkpoint, SurvivesBeingKilledAgainAndAgain) {
  Json scene = readJson(sceneFile("towel_under_hose"));
  scene["duration_s"] = 1.2;
  const std::string path = m_directory.write("scene.json", scene.dump());
  const Json whole = runScene(path);
  double seconds = 0.04;
  int kills = 0;
  Outcome outcome;
  do {
    std::vector<std::string> more = {"--checkpoint", file(), "--every", "5"};
    if (std::filesystem::exists(file())) more.insert(more.end(), {"--resume", file()});
    outcome = runUntilKilled(seconds, runArguments(path, more));
    seconds *= 1.2;
    if (outcome.status != 0) ++kills;
    ASSERT_LT(kills, 100) << outcome.err;
  } while (outcome.status != 0);
  EXPECT_GT(kills, 2);
  EXPECT_EQ(withoutTimes(Json::parse(outcome.out)), withoutTimes(whole));
}
#endif

TEST_F(Checkpoint, OfAnotherRunIsRefused) {
  const std::string scene = m_directory.write("scene.json", smallScene().dump());
  runScene(scene, {"--checkpoint", file(), "--every", "2"});
  const auto resume = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"run", scene, "--resume", file()};
    words.insert(words.end(), more.begin(), more.end());
    return runWetcloth(words);
  };
  expectRefusal(resume({"--quality", "draft"}), {"--resume", file(), "quality \"scene\"", "\"draft\""});
  if (std::filesystem::exists(std::string(WETCLOTH_COMMAND) + "-float64")) {
    expectRefusal(resume({"--precision", "float64"}), {"--resume", file(), "precision \"float32\"", "\"float64\""});
  }
  expectRefusal(resume({"--duration", "3"}), {"--resume", file(), "steps 6", "180"});
  Json changed = smallScene();
  changed["cloths"][0]["friction"] = 0.1;
  m_directory.write("scene.json", changed.dump());
  expectRefusal(resume({}), {"--resume", file(), "another scene"});
}

// What a file holds that the scene names is part of the scene.
TEST_F(Checkpoint, OfOtherCollidersIsRefused) {
  const auto mesh = [this](const std::string& name, const std::string& height) {
    m_directory.write(name, "v -1 0 -1\nv 1 0 -1\nv 0 0 1\nv 0 " + height + " 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
  };
  Json json = smallScene();
  json["colliders"] = {{{"mesh", {{"file", "mesh.obj"}, {"scale", 0.1}}}}};
  const std::string scene = m_directory.write("scene.json", json.dump());
  mesh("mesh.obj", "0.3");
  runScene(scene, {"--checkpoint", file(), "--every", "2"});
  EXPECT_EQ(runWetcloth({"run", scene, "--resume", file()}).status, 0);
  mesh("mesh.obj", "0.45");
  expectRefusal(runWetcloth({"run", scene, "--resume", file()}), {"--resume", file(), "another scene"});
}

TEST_F(Checkpoint, ThatIsDamagedOrNoneIsRefused) {
  const std::string scene = m_directory.write("scene.json", smallScene().dump());
  runScene(scene, {"--checkpoint", file(), "--every", "2"});
  const std::string whole = readBytes(file());
  const auto expectRefused = [&](const std::string& bytes, const std::string& why) {
    const std::string path = m_directory.write("damaged", bytes);
    expectRefusal(runWetcloth({"run", scene, "--resume", path}), {"--resume", path, why});
  };
  expectRefused(whole.substr(0, whole.size() / 2), "damaged");
  std::string changed = whole;
  changed[whole.size() / 2] = static_cast<char>(changed[whole.size() / 2] ^ 4);
  expectRefused(changed, "damaged");
  expectRefused(smallScene().dump(), "no checkpoint");
  expectRefused("", "empty");
  const std::string missing = m_directory.path("missing");
  expectRefusal(runWetcloth({"run", scene, "--resume", missing}), {"--resume", missing, "no such file"});
}

// What a file says of steps counts what is written in memory afterwards.
TEST_F(Checkpoint, OfStepsThatTheRunDoesNotHaveIsRefused) {
  const std::string scene = m_directory.write("scene.json", smallScene().dump());
  runScene(scene, {"--checkpoint", file(), "--every", "2"});
  const std::string whole = readBytes(file());
  const std::string content = whole.substr(whole.find('\n') + 1);
  const std::string state = content.substr(content.find('\n'));
  for (const char* const steps : {"-1", "7", "2.5", "1e300", "4294967300", "\"4\"", "null"}) {
    Json header = Json::parse(content.substr(0, content.find('\n')));
    ASSERT_EQ(header.at("run").at("steps"), 6);
    header.at("progress").at("steps") = Json::parse(steps);
    const std::string path = m_directory.write("changed", command::checkpointFile(header.dump() + state));
    expectRefusal(runWetcloth({"run", scene, "--resume", path}), {"--resume", path, "of 6 steps"});
  }
}

TEST_F(Checkpoint, OptionsAreChecked) {
  const std::string scene = m_directory.write("scene.json", smallScene().dump());
  expectRefusal(runWetcloth({"run", scene, "--checkpoint", file(), "--every", "0"}), {"--every = 0", "at least 1"});
  expectRefusal(runWetcloth({"run", scene, "--checkpoint", m_directory.path("no/such/folder")}),
                {"--checkpoint", "folder"});
  expectRefusal(runWetcloth({"run", scene, "--every", "3"}), {"--every", "--checkpoint"});
  expectRefusal(runWetcloth({"run", scene, "--resume", file(), "--frames", m_directory.path("pictures")}),
                {"--resume", "--frames"});
}

}  // namespace
}  // namespace wetcloth_test::checkpoint_test
