// SPDX-License-Identifier: Zlib
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

namespace wetcloth_test::run_test {
namespace {

using namespace cli;

double centreHeight(const Json& result) { return result.at("centre_of_mass").at(1).get<double>(); }

TEST(Run, EveryExampleSceneGivesAllKeys) {
  const std::vector<std::string> files = sceneFiles();
  ASSERT_GE(files.size(), 8u);
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    const Json result = runCompared(file, {"--duration", "0.1"});
    for (const char* key :
         {"scene", "world", "precision", "steps", "dt", "nodes", "links", "effects", "wall_ms_per_step",
          "bullet_ms_per_step", "ledger", "saturation", "centre_of_mass", "max_speed", "max_stretch", "state_hash"}) {
      EXPECT_TRUE(result.contains(key)) << key;
    }
    for (const char* key : {"initial", "absorbed", "evaporated", "dripped", "held"}) {
      EXPECT_TRUE(result.at("ledger").at(key).is_number()) << key;
    }
    for (const char* key : {"min", "mean", "max"}) EXPECT_TRUE(result.at("saturation").at(key).is_number()) << key;
    EXPECT_EQ(result.at("centre_of_mass").size(), 3u);
    EXPECT_EQ(result.at("precision"), testedPrecision());
    EXPECT_EQ(result.at("steps"), std::lround(0.1 / result.at("dt").get<double>()));
    EXPECT_GT(result.at("wall_ms_per_step"), 0);
    EXPECT_GT(result.at("bullet_ms_per_step"), 0);
  }
}

TEST(Run, SameSceneSameHash) {
  for (const char* name : {"flag_wind_100", "curtain_deformable", "soak_and_drape_sphere"}) {
    const Json first = runScene(sceneFile(name), {"--duration", "0.2"});
    const Json second = runScene(sceneFile(name), {"--duration", "0.2"});
    EXPECT_EQ(first.at("state_hash"), second.at("state_hash")) << name;
    EXPECT_EQ(first.at("state_hash").get<std::string>().size(), 16u);
  }
}

TEST(Run, HashDiffersWhenTheWaterDiffers) {
  Json scene = smallScene();
  const Json dry = runScene(scene);
  scene["cloths"][0]["initial_saturation"] = 0.1;
  EXPECT_NE(dry.at("state_hash"), runScene(scene).at("state_hash"));
}

TEST(Run, WithoutEffectsAClothFallsAsInAVacuum) {
  for (const char* world : {"soft_rigid", "soft_multibody", "deformable"}) {
    Json scene = smallScene();
    scene["world"] = world;
    scene["duration_s"] = 0.5;
    scene["cloths"][0].erase("effects");
    const Json result = runScene(scene);
    const double time = result.at("steps").get<double>() * result.at("dt").get<double>();
    const double substep = result.at("dt").get<double>() / 4;
    EXPECT_NEAR(centreHeight(result), 1 - 0.5 * 9.81 * time * time, 9.81 * time * substep) << world;
    EXPECT_TRUE(result.at("effects").empty());
    EXPECT_EQ(result.at("ledger").at("held"), 0);
  }
}

TEST(Run, AbsorptionFollowsItsClosedFormAndTheLedgerCloses) {
  Json scene = smallScene();
  scene["cloths"][0]["effects"]["absorption"]["exposure"] = 0.5;
  scene["cloths"][0]["initial_saturation"] = 0.25;
  const Json result = runScene(scene, {"--duration", "1"});
  const double time = result.at("steps").get<double>() * result.at("dt").get<double>();
  const double expected = 1 - 0.75 * std::exp(-0.5 * time / 8.844);
  EXPECT_NEAR(result.at("saturation").at("mean").get<double>(), expected, 1e-6);
  const Json& ledger = result.at("ledger");
  const double held = 0.15 * 0.84 * expected;  // one square metre
  EXPECT_NEAR(ledger.at("held").get<double>(), held, 1e-6);
  EXPECT_NEAR(ledger.at("initial").get<double>() + ledger.at("absorbed").get<double>() -
                  ledger.at("dripped").get<double>() - ledger.at("evaporated").get<double>(),
              ledger.at("held").get<double>(), 1e-12 * held);
}

TEST(Run, OnlyWhatLiesBelowTheSurfaceGetsWet) {
  Json scene = smallScene();
  scene["gravity_m_s2"] = {0, 0, 0};
  scene["cloths"][0]["patch"]["edge_v_m"] = {0, 1, 0};  // upright, from 1 m to 2 m
  scene["cloths"][0]["effects"] = {{"absorption", {{"exposure", {{"below_m", 1.5}}}}}};
  const Json result = runScene(scene);
  EXPECT_EQ(result.at("saturation").at("min"), 0);
  EXPECT_GT(result.at("saturation").at("max"), 0);
}

TEST(Run, SaturatedClothFallsFasterThroughAir) {
  const Json dry = runScene(sceneFile("fall_dry"), {"--duration", "0.7"});
  const Json wet = runScene(sceneFile("fall_wet"), {"--duration", "0.7"});
  EXPECT_LT(centreHeight(wet), centreHeight(dry) - 0.1);
  EXPECT_DOUBLE_EQ(wet.at("saturation").at("min").get<double>(), 1);
}

TEST(Run, ThePapersThreeWindsLiftTheFlagHigherAndStayStable) {
  double lower = 0;
  for (const char* name : {"flag_wind_050", "flag_wind_100", "flag_wind_150"}) {
    const Json result = runScene(sceneFile(name), {"--duration", "2"});
    EXPECT_GT(centreHeight(result), lower) << name;
    EXPECT_LT(result.at("max_speed").get<double>(), 10) << name;
    EXPECT_LT(result.at("max_stretch").get<double>(), 1.5) << name;
    lower = centreHeight(result);
  }
}

TEST(Run, ASceneDecidesItsPrecision) {
  if (!std::ifstream(WETCLOTH_COMMAND "-float64")) GTEST_SKIP() << "Bullet was found in one precision only";
  for (const char* precision : {"float32", "float64"}) {
    Json scene = smallScene();
    scene["precision"] = precision;
    const TemporaryDirectory directory;
    const Outcome outcome = runWetcloth({"run", directory.write("scene.json", scene.dump()), "--json", "-"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(Json::parse(outcome.out).at("precision"), precision);
  }
}

TEST(Run, AMeshFromAFileRunsLikeAPatch) {
  const TemporaryDirectory directory;
  directory.write("square.obj",
                  "# a square metre\nv 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\nv 0.5 1 0.5\n"
                  "f 1 2 5\nf 2/1/1 3//2 5\nf -3 -2 -1\nf 4 1 5\n");
  Json scene = smallScene();
  scene["cloths"][0].erase("patch");
  scene["cloths"][0]["obj"] = "square.obj";
  scene["cloths"][0]["pins"] = {{"nodes", {0}}};
  const Json result = runScene(directory.write("scene.json", scene.dump()));
  EXPECT_EQ(result.at("nodes"), 5);
  EXPECT_EQ(result.at("links"), 8 + 2);  // edges, and the two diagonals that keep it from bending
  EXPECT_LE(result.at("ledger").at("held").get<double>(), 0.15 * 0.84);
}

TEST(Run, FramesArePicturesEvenlySpaced) {
  const TemporaryDirectory directory;
  runScene(smallScene(), {"--frames", directory.path("pictures"), "--frame-count", "3"});
  for (const char* name : {"frame_0000.svg", "frame_0001.svg", "frame_0002.svg"}) {
    std::ifstream file(directory.path("pictures") + "/" + name);
    const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    EXPECT_EQ(text.rfind("<svg ", 0), 0u) << name;
    EXPECT_NE(text.find("</svg>"), std::string::npos) << name;
    EXPECT_EQ(text.find("nan"), std::string::npos) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(directory.path("pictures") + "/frame_0003.svg"));
}

TEST(Run, WithoutJsonPrintsASummaryAndWithAFilePrintsBoth) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", smallScene().dump());
  const Outcome outcome = runWetcloth({"run", file, "--json", directory.path("result.json")});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.out.find("state hash"), std::string::npos);
  EXPECT_TRUE(readJson(directory.path("result.json")).contains("state_hash"));
}

TEST(Run, WithoutTheComparisonAllButBulletsTimeIsTheSame) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", smallScene().dump());
  Json compared = runCompared(file);
  Json alone = runCompared(file, {"--no-comparison"});
  EXPECT_EQ(compared.erase("bullet_ms_per_step"), 1u);
  EXPECT_GT(alone.at("wall_ms_per_step"), 0);
  for (Json* report : {&compared, &alone}) report->erase("wall_ms_per_step");
  EXPECT_EQ(alone, compared);
  EXPECT_NE(runWetcloth({"run", file}).out.find("; plain Bullet "), std::string::npos);
  EXPECT_EQ(runWetcloth({"run", file, "--no-comparison"}).out.find("plain Bullet"), std::string::npos);
}

TEST(Run, ARunThatIsRefusedLeavesNoFile) {
  Json scene = smallScene();
  scene["world"] = "deformable";
  scene["cloths"][0]["effects"] = {{"wet_stiffness", Json::object()}};  // which only the library refuses
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", scene.dump());
  const std::string pictures = directory.path("pictures");
  EXPECT_EQ(runWetcloth({"run", file, "--frames", pictures, "--json", directory.path("result.json")}).status, 2);
  EXPECT_TRUE(std::filesystem::is_empty(pictures));
  EXPECT_FALSE(std::filesystem::exists(directory.path("result.json")));
}

TEST(Run, AStateThatBlewUpIsARunThatFailed) {
  Json scene = smallScene();
  scene["cloths"][0]["effects"]["wind"] = {{"velocity_m_s", {0, 1e5, 1e5}}, {"integration", "explicit_euler"}};
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", scene.dump());
  const Outcome outcome = runWetcloth({"run", file, "--precision", testedPrecision()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find(file + ": the cloth blew up in step "), std::string::npos) << outcome.err;
}

TEST(Validate, SaysOkForEachExampleScene) {
  std::vector<std::string> arguments{"validate"};
  std::string expected;
  for (const std::string& file : sceneFiles()) {
    arguments.push_back(file);
    expected += file + ": ok\n";
  }
  const Outcome outcome = runWetcloth(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, expected);
}

}  // namespace
}  // namespace wetcloth_test::run_test
