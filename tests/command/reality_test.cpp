// SPDX-License-Identifier: Zlib
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace wetcloth_test::reality_test {
namespace {

using namespace cli;

TEST(Reality, TellsModelBesideDataAndBothErrors) {
  const TemporaryDirectory directory;
  const Outcome outcome = runWetcloth({"reality", "--study", "shirts", "--out", directory.path("out"), "--json", "-",
                                       "--precision", testedPrecision()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json study = Json::parse(outcome.out).at("studies").at(0);
  for (const char* half : {"fitted", "predicted"}) {
    EXPECT_EQ(study.at(half).at("readings"), 8) << half;
    EXPECT_GT(study.at(half).at("rms_of_range").get<double>(), 0) << half;
    EXPECT_GT(study.at(half).at("rms_of_uncertainty").get<double>(), 0) << half;
  }
  ASSERT_EQ(study.at("groups").size(), 2u);
  for (const Json& group : study.at("groups")) {
    EXPECT_GT(group.at("rate_kg_m2_s").get<double>(), 0);
    for (const Json& reading : group.at("samples")[0].at("readings")) {
      EXPECT_TRUE(reading.at("measured").is_number() && reading.at("model").is_number());
    }
  }
  for (const char* file : {"/shirts.csv", "/studies.md"}) {
    EXPECT_TRUE(std::filesystem::exists(directory.path("out") + file)) << file;
  }
}

TEST(Reality, TextHasEveryReadingAndAVerdict) {
  const Outcome outcome = runWetcloth({"reality", "--study", "sheet", "--precision", testedPrecision()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* word : {"fall_a4_sheet_2013", "drag_coefficient", "5.25", "predicted half", "The prediction is"}) {
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word << " in " << outcome.out;
  }
}

TEST(Reality, ListsItsStudiesToWhoNamesAnother) {
  expectRefusal(runWetcloth({"reality", "--study", "shirt"}),
                {"--study", "\"shirt\"", "\"shirts\"", "towels", "wicking"});
  expectRefusal(runWetcloth({"reality", "--study", "sheet", "--out", "/dev/null/x"}), {"--out"});
}

}  // namespace
}  // namespace wetcloth_test::reality_test
