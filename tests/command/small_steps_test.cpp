// SPDX-License-Identifier: Zlib
// `wetcloth run --small-steps`: the nodes' places after each small step, in the format that docs/scenes.md describes.

#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace wetcloth_test::small_steps_test {
namespace {

using namespace cli;

constexpr double g = 9.81;

struct Record {
  std::uint32_t substep;
  std::uint32_t smallStep;
  std::uint32_t cloth;
  std::vector<double> places;  ///< x, y, z of each node [m]
};

struct SmallSteps {
  Json head;
  std::vector<Record> records;
};

template <class Number>
Number take(const std::string& bytes, std::size_t& at) {
  Number number;
  std::memcpy(&number, bytes.data() + at, sizeof number);  // x86 has the lowest byte first, as the file
  at += sizeof number;
  return number;
}

SmallSteps readSmallSteps(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  std::size_t at = bytes.find('\n') + 1;
  SmallSteps all{Json::parse(bytes.substr(0, at)), {}};
  while (at < bytes.size()) {
    Record record{take<std::uint32_t>(bytes, at), take<std::uint32_t>(bytes, at), take<std::uint32_t>(bytes, at), {}};
    const auto nodes = take<std::uint32_t>(bytes, at);
    for (std::uint32_t i = 0; i < 3 * nodes; ++i) record.places.push_back(take<double>(bytes, at));
    all.records.push_back(record);
  }
  return all;
}

// So many in each substep, which is 1/240 s.
Json sceneOf(int smallSteps) {
  Json scene = smallScene();
  scene["solver"] = {{"small_steps", 4 * smallSteps}};
  return scene;
}

TEST(SmallSteps, OfAFallAreThoseOfTheClosedForm) {
  Json scene = sceneOf(7);
  scene["cloths"][0].erase("effects");
  const TemporaryDirectory directory;
  const std::string file = directory.path("small.steps");
  const Json report = runScene(scene, {"--small-steps", file});
  const SmallSteps all = readSmallSteps(file);
  const double substep = scene["step_s"].get<double>() / 4;
  EXPECT_EQ(all.head.at("wetcloth_small_steps"), 1);
  EXPECT_EQ(all.head.at("small_steps"), 7);
  EXPECT_NEAR(all.head.at("substep_s").get<double>(), substep, 1e-12);
  EXPECT_EQ(all.head.at("nodes"), Json({20}));
  ASSERT_EQ(all.records.size(), report.at("steps").get<std::size_t>() * 4 * 7);
  const double h = substep / 7;
  for (std::size_t n = 0; n < all.records.size(); ++n) {
    const Record& record = all.records[n];
    ASSERT_EQ(record.substep, n / 7);
    ASSERT_EQ(record.smallStep, n % 7);
    ASSERT_EQ(record.cloth, 0u);
    ASSERT_EQ(record.places.size(), 60u);
    const double count = static_cast<double>(n + 1);
    const double height = 1 - g * h * h * count * (count + 1) / 2;  // from v += g h, y += v h
    for (std::size_t i = 1; i < 60; i += 3) ASSERT_NEAR(record.places[i], height, 1e-5) << n;
  }
}

TEST(SmallSteps, OfSeveralClothsAreToldApart) {
  Json scene = sceneOf(3);
  scene["cloths"].push_back(scene["cloths"][0]);
  scene["cloths"].push_back(scene["cloths"][0]);
  scene["cloths"][0]["collisions"] = {"VF_SS"};  // not taken
  scene["cloths"][2]["patch"]["columns"] = 3;
  scene["cloths"][2]["patch"]["origin_m"] = {0, 9, 0};
  const TemporaryDirectory directory;
  const std::string file = directory.path("small.steps");
  runScene(scene, {"--small-steps", file});
  const SmallSteps all = readSmallSteps(file);
  EXPECT_EQ(all.head.at("nodes"), Json({20, 20, 12}));
  std::vector<std::size_t> counts(3);
  for (const Record& record : all.records) {
    ASSERT_LT(record.cloth, 3u);
    ++counts[record.cloth];
    EXPECT_EQ(record.places.size(), record.cloth == 1 ? 60u : 36u);
    EXPECT_NEAR(record.places[1], record.cloth == 1 ? 1 : 9, 0.1);
  }
  const std::size_t expected = 6 * 4 * 3;  // a substep has a quarter of twelve
  EXPECT_EQ(counts, (std::vector<std::size_t>{0, expected, expected}));
}

TEST(SmallSteps, ChangeNothing) {
  const TemporaryDirectory directory;
  const Json with = runScene(sceneOf(5), {"--small-steps", directory.path("small.steps")});
  EXPECT_EQ(with.at("state_hash"), runScene(sceneOf(5)).at("state_hash"));
}

TEST(SmallSteps, OfAResumedRunGoOnCounting) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.json", sceneOf(5).dump());
  const std::string state = directory.path("run.state");
  const std::string file = directory.path("small.steps");
  runScene(scene, {"--checkpoint", state, "--every", "4"});  // of 6 steps
  runScene(scene, {"--resume", state, "--small-steps", file});
  const SmallSteps all = readSmallSteps(file);
  ASSERT_EQ(all.records.size(), 2u * 4 * 5);
  EXPECT_EQ(all.records.front().substep, 16u);
  EXPECT_EQ(all.records.back().substep, 23u);
}

TEST(SmallSteps, NeedTheSolverThatTakesThem) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.json", smallScene().dump());
  const std::string file = directory.path("small.steps");
  expectRefusal(runWetcloth({"run", scene, "--small-steps", file}), {"--small-steps", file, "--solver wetcloth"});
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_EQ(runWetcloth({"run", scene, "--small-steps", file, "--solver", "wetcloth"}).status, 0);
  EXPECT_TRUE(std::filesystem::exists(file));
  expectRefusal(runWetcloth({"run", scene, "--solver", "wetcloth", "--small-steps", "/no/such/folder/small.steps"}),
                {"--small-steps", "/no/such/folder"});
}

}  // namespace
}  // namespace wetcloth_test::small_steps_test
