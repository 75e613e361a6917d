// SPDX-License-Identifier: Zlib
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

namespace wetcloth_test::stability_test {
namespace {

using namespace cli;

Json stabilityOf(std::vector<std::string> more) {
  std::vector<std::string> arguments{"stability", "--json", "-", "--precision", testedPrecision()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = runWetcloth(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.status == 0 ? Json::parse(outcome.out) : Json();
}

std::set<std::string> valuesOf(const Json& cases, const char* key) {
  std::set<std::string> values;
  for (const Json& one : cases) values.insert(one.at(key).get<std::string>());
  return values;
}

TEST(Stability, JsonHasEveryKey) {
  const Json report = stabilityOf({"--case", "wind_50", "--step", "1/30"});
  EXPECT_EQ(report.at("precision"), testedPrecision());
  EXPECT_EQ(report.at("fails"), 0);
  ASSERT_EQ(report.at("cases").size(), 5U);
  for (const Json& one : report.at("cases")) {
    EXPECT_EQ(one.at("name"), "wind_50");
    EXPECT_EQ(one.at("group"), "winds");
    EXPECT_EQ(one.at("precision"), testedPrecision());
    EXPECT_DOUBLE_EQ(one.at("step").get<double>(), 1. / 30);
    EXPECT_TRUE(one.at("bound").is_string());
    for (const char* const key : {"plain_bullet", "obvious_way"}) {
      EXPECT_TRUE(one.at(key).at("verdict").is_string()) << key;
      EXPECT_TRUE(one.at(key).contains("margin")) << key;
    }
    EXPECT_EQ(one.at("obvious_way").at("name"), "explicit wind");
  }
  EXPECT_EQ(valuesOf(report.at("cases"), "world"),
            (std::set<std::string>{"soft_rigid", "soft_multibody", "deformable", "deformable_implicit",
                                   "soft_rigid_cloth_solver"}));
  const Json& first = report.at("cases").at(0);
  EXPECT_EQ(first.at("verdict"), "holds");
  EXPECT_GT(first.at("margin").get<double>(), 0);
  EXPECT_LE(first.at("margin").get<double>(), 1);
  EXPECT_EQ(first.at("obvious_way").at("verdict"), "fails") << "an explicit wind of 50 m/s at 1/30 s";
}

TEST(Stability, FiltersNarrowTheTable) {
  const Json ofGroup = stabilityOf({"--group", "cubics"}).at("cases");
  EXPECT_GE(ofGroup.size(), 5U);
  EXPECT_EQ(valuesOf(ofGroup, "world"), std::set<std::string>{"none"});
  const Json ofWorld = stabilityOf({"--case", "wind_edge_on", "--world", "deformable"}).at("cases");
  EXPECT_EQ(ofWorld.size(), 5U) << "every step";
  EXPECT_EQ(stabilityOf({"--case", "wind_edge_on", "--world", "deformable", "--quick"}).at("cases").size(), 2U);
  EXPECT_EQ(stabilityOf({"--case", "wind_edge_on", "--world", "soft_rigid", "--step", "0.02"}).at("cases").size(), 1U);
}

TEST(Stability, TextShowsEachRowAndTheSum) {
  const Outcome outcome = runWetcloth({"stability", "--case", "lone_triangle", "--step", "1/60"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* word : {"lone_triangle", "soft_multibody", "1/60", "holds", "5 runs in ", "0 fail"}) {
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
  }
}

TEST(Stability, MarkdownGoesBetweenItsLines) {
  const TemporaryDirectory directory;
  const std::string name = "stability " + testedPrecision();
  const std::string file =
      directory.write("page.md", "before\n<!-- " + name + " -->\nOLD TABLE\n<!-- end of " + name + " -->\nafter\n");
  const Outcome outcome = runWetcloth(
      {"stability", "--case", "wind_edge_on", "--step", "1/30", "--precision", testedPrecision(), "--markdown", file});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  EXPECT_EQ(text.find("before\n"), 0U);
  EXPECT_EQ(text.substr(text.size() - 6), "after\n");
  EXPECT_EQ(text.find("OLD TABLE"), std::string::npos);
  EXPECT_NE(text.find("| `wind_edge_on` | soft_rigid |"), std::string::npos) << text;
}

TEST(Stability, OutcomesAreWrittenAnew) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("outcomes.txt", "OLD\n");
  const Outcome outcome = runWetcloth({"stability", "--case", "wind_edge_on", "--world", "soft_rigid", "--quick",
                                       "--precision", testedPrecision(), "--outcomes", file});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  EXPECT_EQ(text.find("OLD"), std::string::npos);
  EXPECT_NE(text.find("\nwind_edge_on soft_rigid 1/240 holds 1/30 holds\n"), std::string::npos) << text;
}

TEST(Stability, BadInputIsRefusedInOneLine) {
  expectRefusal(runWetcloth({"stability", "--case", "wind_edge_onn"}), {"--case", "wind_edge_onn", "wind_edge_on"});
  expectRefusal(runWetcloth({"stability", "--group", "wind"}), {"--group", "winds"});
  expectRefusal(runWetcloth({"stability", "--world", "soft"}), {"--world", "soft_rigid"});
  expectRefusal(runWetcloth({"stability", "--outcomes", "/no/such/folder/x.txt"}), {"--outcomes", "/no/such/folder"});
  expectRefusal(runWetcloth({"stability", "--precision", "half"}), {"--precision", "float32"});
  for (const char* const step : {"0", "-1", "2", "1/0", "1/x", "nan", "1/240s", "/"}) {
    expectRefusal(runWetcloth({"stability", "--step", step}), {"--step", step, "[0.0001, 1]"});
  }
  expectRefusal(runWetcloth({"stability", "--case", "cubic_coplanar", "--world", "deformable"}), {"no case is left"});
  expectRefusal(runWetcloth({"stability", "--case", "wind_0", "--json", "/no/such/folder/x.json"}),
                {"/no/such/folder"});
  expectRefusal(runWetcloth({"stability", "--case", "wind_0", "--markdown", "/no/such/page.md"}), {"/no/such/page.md"});
}

}  // namespace
}  // namespace wetcloth_test::stability_test
