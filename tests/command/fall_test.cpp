// SPDX-License-Identifier: Zlib
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

namespace wetcloth_test::fall_test {
namespace {

using namespace cli;

constexpr double g = 9.81;
constexpr double substep = 1.0 / 240;

Json fall(std::vector<std::string> more) {
  std::vector<std::string> arguments{"fall", "--json", "-", "--precision", testedPrecision()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = runWetcloth(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.status == 0 ? Json::parse(outcome.out).at("cases") : Json::array();
}

Json caseNamed(const Json& cases, const std::string& name) {
  for (const Json& one : cases) {
    if (one.at("name") == name) return one;
  }
  ADD_FAILURE() << "no case " << name;
  return Json();
}

/// Distance fallen through air that resists in proportion to speed; tau = m / c.
double linearDistance(double t, double tau) { return g * tau * (t - tau * (1 - std::exp(-t / tau))); }
/// Distance fallen through air that resists in proportion to speed squared.
double quadraticDistance(double t, double terminal) {
  return terminal * terminal / g * std::log(std::cosh(g * t / terminal));
}

void expectWithinOneSubstep(const Json& cases) {
  for (const Json& one : cases) {
    EXPECT_NEAR(one.at("time_s").get<double>(), one.at("closed_form_s").get<double>(), substep) << one.dump();
    EXPECT_GT(one.at("fps").get<double>(), 0);
  }
}

using FallInWorld = testing::TestWithParam<const char*>;

// In one world from the heights of the paper. In the others a cloth falls less far, dry ones to nearly their final
// speed all the same: the deformable world takes ten times as long, and that of multibodies differs in its rigid bodies
// alone.
bool isFromThePapersHeight(const std::string& world) { return world == "soft_rigid"; }
double paperHeight(const std::string& world) { return isFromThePapersHeight(world) ? 19.62 : 4; }
double physicalHeight(const std::string& world) { return isFromThePapersHeight(world) ? 5.5 : 1.5; }

TEST_P(FallInWorld, PaperFourSecondsDryTwoSaturated) {
  const double height = paperHeight(GetParam());
  const Json cases = fall({"--world", GetParam(), "--height", std::to_string(height)});
  ASSERT_GE(cases.size(), 7u);
  expectWithinOneSubstep(cases);
  EXPECT_NEAR(caseNamed(cases, "bullet").at("time_s").get<double>(), std::sqrt(2 * height / g), substep);
  EXPECT_DOUBLE_EQ(caseNamed(cases, "saturated").at("wet_dry_mass_ratio").get<double>(), 84);
  for (const Json& one : cases) {
    if (one.at("name") == "bullet") continue;
    const double tau = 0.585 * one.at("wet_dry_mass_ratio").get<double>();
    EXPECT_NEAR(linearDistance(one.at("closed_form_s").get<double>(), tau), height, 1e-9) << one.dump();
  }
  if (!isFromThePapersHeight(GetParam())) return;
  EXPECT_NEAR(caseNamed(cases, "dry").at("time_s").get<double>(), 4.00, 0.01);
  EXPECT_NEAR(caseNamed(cases, "saturated").at("time_s").get<double>(), 2.01, 0.01);
}

TEST_P(FallInWorld, PhysicalSaturatedCottonDoesNotHalveTheTime) {
  const double height = physicalHeight(GetParam());
  const Json cases = fall({"--world", GetParam(), "--mode", "physical", "--height", std::to_string(height)});
  expectWithinOneSubstep(cases);
  for (const Json& one : cases) {
    if (one.at("name") == "bullet") continue;
    const double terminal = std::sqrt(2 * 0.150 * one.at("wet_dry_mass_ratio").get<double>() * g / (1.225 * 1.2));
    EXPECT_NEAR(quadraticDistance(one.at("closed_form_s").get<double>(), terminal), height, 1e-9) << one.dump();
  }
  if (!isFromThePapersHeight(GetParam())) return;
  EXPECT_NEAR(caseNamed(cases, "dry").at("time_s").get<double>(), 3.99, 0.01);
  EXPECT_NEAR(caseNamed(cases, "saturated").at("time_s").get<double>(), 3.00, 0.01);
  EXPECT_NEAR(caseNamed(cases, "4 x dry").at("time_s").get<double>(), 2.14, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Worlds, FallInWorld, testing::Values("soft_rigid", "soft_multibody", "deformable"));

using FallOnClothSolver = testing::TestWithParam<const char*>;

TEST_P(FallOnClothSolver, FallsAsTheClosedFormSays) {
  const double paper = paperHeight(GetParam());
  const double physical = physicalHeight(GetParam());
  for (const auto& [mode, height] : {std::pair("paper", paper), std::pair("physical", physical)}) {
    const Json cases =
        fall({"--world", GetParam(), "--mode", mode, "--solver", "wetcloth", "--height", std::to_string(height)});
    ASSERT_GE(cases.size(), 7u);
    expectWithinOneSubstep(cases);
  }
}

INSTANTIATE_TEST_SUITE_P(Worlds, FallOnClothSolver, testing::Values("soft_rigid", "soft_multibody"));

TEST(Fall, SaysWhichSolver) {
  const auto solverOf = [](const std::vector<std::string>& more) {
    std::vector<std::string> words{"fall", "--height", "0.01", "--json", "-"};
    words.insert(words.end(), more.begin(), more.end());
    return Json::parse(runWetcloth(words).out).at("solver").get<std::string>();
  };
  EXPECT_EQ(solverOf({}), "bullet");
  EXPECT_EQ(solverOf({"--solver", "bullet"}), "bullet");
  EXPECT_EQ(solverOf({"--solver", "wetcloth"}), "wetcloth");
}

TEST(Fall, TheDeformableWorldHasNoOtherSolver) {
  expectRefusal(runWetcloth({"fall", "--world", "deformable", "--solver", "wetcloth"}),
                {"--solver = \"wetcloth\"", "\"bullet\"", "deformable"});
}

TEST(Fall, OtherHeights) {
  for (const char* height : {"0.01", "1"}) expectWithinOneSubstep(fall({"--height", height}));
}

TEST(Fall, TableShowsEveryCaseWithItsClosedForm) {
  const Outcome outcome = runWetcloth({"fall", "--mode", "physical", "--height", "0.5"});
  EXPECT_EQ(outcome.status, 0);
  for (const char* word : {"bullet", "dry", "saturated", "closed form", "error", "does not halve the time"}) {
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace wetcloth_test::fall_test
