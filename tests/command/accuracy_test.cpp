// SPDX-License-Identifier: Zlib
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

// What a machine takes is never asserted here, only what is said about it.

namespace wetcloth_test::accuracy_test {
namespace {

using namespace cli;

TEST(AccuracyCommand, TellsPointsFrontOrderAndAdvice) {
  const TemporaryDirectory directory;
  const Outcome outcome = runWetcloth({"accuracy", "--quick", "--study", "absorption", "--out", directory.path("out"),
                                       "--json", "-", "--precision", testedPrecision()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json result = Json::parse(outcome.out);
  ASSERT_EQ(result.at("studies").size(), 1u);
  const Json& study = result.at("studies")[0];
  for (const char* key : {"name", "knob", "reference", "reference_error", "error_is", "timed", "orders", "advice"}) {
    EXPECT_TRUE(study.contains(key)) << key;
  }
  bool hasFront = false;
  for (const Json& point : study.at("points")) {
    EXPECT_TRUE(point.at("setting").is_string());
    EXPECT_TRUE(point.at("error").is_number());
    EXPECT_GT(point.at("ns_per_node_step").get<double>(), 0);
    hasFront = hasFront || point.at("on_front").get<bool>();
  }
  EXPECT_TRUE(hasFront);
  for (const char* file : {"absorption.csv", "studies.md", "measured.json"}) {
    EXPECT_TRUE(std::filesystem::exists(directory.path("out") + "/" + file)) << file;
  }
}

TEST(AccuracyCommand, RefusesWhatItDoesNotKnow) {
  expectRefusal(runWetcloth({"accuracy", "--study", "wnd"}), {"--study", "\"wnd\"", "\"wind\""});
  expectRefusal(runWetcloth({"accuracy", "--precision", "float16"}), {"--precision", "\"float16\""});
  expectRefusal(runWetcloth({"accuracy", "--study", "absorption", "--out", "/dev/null/x"}), {"--out"});
}

TEST(ErrorBudget, ChoosesAndSaysWhatItChose) {
  const Json coarse = runScene(sceneFile("flag_wind_100"), {"--duration", "0.1", "--error-budget", "0.1"});
  const Json fine = runScene(sceneFile("flag_wind_100"), {"--duration", "0.1", "--error-budget", "1e-2"});
  EXPECT_EQ(fine.at("quality"), "error budget");
  EXPECT_GT(fine.at("substeps").get<int>(), coarse.at("substeps").get<int>());
  ASSERT_TRUE(fine.at("expected_errors").contains("wind_quadratic"));
  for (const auto& [study, error] : fine.at("expected_errors").items()) EXPECT_LE(error.get<double>(), 1e-2) << study;
}

TEST(ErrorBudget, ThatNothingReachesIsRefusedWithWhatIsPossible) {
  expectRefusal(runWetcloth({"run", sceneFile("flag_wind_100"), "--error-budget", "1e-9"}),
                {"--error-budget = 1e-09", "must be at least", "wind_quadratic"});
  expectRefusal(runWetcloth({"run", sceneFile("flag_wind_100"), "--error-budget", "-1"}), {"--error-budget = -1"});
  expectRefusal(runWetcloth({"run", sceneFile("flag_wind_100"), "--error-budget", "nan"}), {"--error-budget = nan"});
  expectRefusal(runWetcloth({"run", sceneFile("flag_wind_100"), "--error-budget", "0.1", "--quality", "draft"}),
                {"--error-budget", "--quality"});
}

TEST(Quality, ASceneNamesOneAndTheOptionOverrulesIt) {
  Json scene = smallScene();
  EXPECT_EQ(runScene(scene).at("quality"), "scene");
  EXPECT_EQ(runScene(scene).at("substeps"), scene.at("substeps"));
  scene["quality"] = "accurate";
  const Json own = runScene(scene);
  EXPECT_EQ(own.at("quality"), "accurate");
  EXPECT_FALSE(own.at("expected_errors").empty());
  EXPECT_EQ(runScene(scene, {"--quality", "draft"}).at("quality"), "draft");
}

TEST(Quality, IsOrderedFromDraftToReference) {
  int work = 0;
  for (const char* quality : {"draft", "realtime", "accurate", "reference"}) {
    const Json result = runScene(sceneFile("flag_wind_100"), {"--duration", "0.05", "--quality", quality});
    const int substeps = result.at("substeps");
    EXPECT_GE(substeps, work) << quality;
    work = substeps;
  }
}

}  // namespace
}  // namespace wetcloth_test::accuracy_test
