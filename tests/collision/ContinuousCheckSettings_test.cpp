// SPDX-License-Identifier: Zlib
// Settings out of range are refused where they are given, with the field's name and the value.

#include "tests/support/QueryGenerator.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace wetcloth_test::continuous_check_settings_test {
namespace {

// The message of the std::invalid_argument that the settings cause; empty when they are taken.
std::string refusalOf(Tier tier, const CheckSettings& settings) {
  try {
    const ContinuousCheck check(tier, settings);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

void expectRefused(const CheckSettings& settings, const std::string& field, const std::string& value,
                   const std::vector<Tier>& tiers) {
  for (const Tier tier : tiers) {
    const std::string message = refusalOf(tier, settings);
    EXPECT_NE(message.find(field), std::string::npos) << "names " << field << ": '" << message << "'";
    EXPECT_NE(message.find(value), std::string::npos) << "shows " << value << ": '" << message << "'";
    EXPECT_EQ(message.find('\n'), std::string::npos) << "one line";
  }
}

std::vector<Tier> everyTier() {
  std::vector<Tier> tiers = {Tier::fast, Tier::conservative};
  if (ContinuousCheck::hasExact()) tiers.push_back(Tier::exact);
  return tiers;
}

const double kNaN = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

TEST(ContinuousCheckSettings, AToleranceOutOfRangeIsRefused) {
  const std::pair<double, const char*> bad[] = {{0, "0"},      {-1, "-1"},         {1e-13, "1e-13"},    {2, "2"},
                                                {kNaN, "nan"}, {kInfinity, "inf"}, {-kInfinity, "-inf"}};
  for (const auto& [value, text] : bad) {
    CheckSettings settings;
    settings.tolerance = value;
    expectRefused(settings, "tolerance", text, everyTier());
  }
}

TEST(ContinuousCheckSettings, ABudgetOfNothingIsRefused) {
  for (const int value : {0, -1, std::numeric_limits<int>::min()}) {
    CheckSettings settings;
    settings.maxIntervals = value;
    expectRefused(settings, "maxIntervals", std::to_string(value), everyTier());
  }
}

TEST(ContinuousCheckSettings, ASeparationOutOfRangeIsRefused) {
  const std::pair<double, const char*> bad[] = {
      {-1, "-1"}, {-1e-300, "-1e-300"}, {kNaN, "nan"}, {kInfinity, "inf"}, {-kInfinity, "-inf"}};
  for (const auto& [value, text] : bad) {
    CheckSettings settings;
    settings.minSeparation = value;
    expectRefused(settings, "minSeparation", text, everyTier());
  }
}

TEST(ContinuousCheckSettings, ExactTakesNoSeparation) {
  if (!ContinuousCheck::hasExact()) GTEST_SKIP() << "a build without Tier::exact";
  CheckSettings settings;
  settings.minSeparation = 0.25;
  expectRefused(settings, "minSeparation", "0.25", {Tier::exact});
  EXPECT_EQ(refusalOf(Tier::conservative, settings), "");
  EXPECT_EQ(refusalOf(Tier::fast, settings), "");
}

TEST(ContinuousCheckSettings, ABuildWithoutExactSaysSo) {
  if (ContinuousCheck::hasExact()) {
    EXPECT_NO_THROW(ContinuousCheck{Tier::exact});
  } else {
    EXPECT_THROW(ContinuousCheck{Tier::exact}, std::runtime_error);
  }
}

TEST(ContinuousCheckSettings, TheEndsOfTheRangesAreTaken) {
  for (const double tolerance : {1e-12, 1.0}) {
    for (const int budget : {1, std::numeric_limits<int>::max()}) {
      for (const Tier tier : everyTier()) {
        CheckSettings settings;
        settings.tolerance = tolerance;
        settings.maxIntervals = budget;
        settings.minSeparation = tier == Tier::exact ? 0 : std::numeric_limits<double>::max();
        EXPECT_EQ(refusalOf(tier, settings), "");
      }
    }
  }
}

TEST(ContinuousCheckSettings, AreKept) {
  CheckSettings settings;
  settings.tolerance = 0.5;
  settings.maxIntervals = 3;
  settings.minSeparation = 0.125;
  const ContinuousCheck check(Tier::fast, settings);
  EXPECT_EQ(check.tier(), Tier::fast);
  EXPECT_EQ(check.settings().tolerance, 0.5);
  EXPECT_EQ(check.settings().maxIntervals, 3);
  EXPECT_EQ(check.settings().minSeparation, 0.125);
  EXPECT_EQ(ContinuousCheck().tier(), Tier::conservative);
}

// With one interval to look at there is the whole motion and nothing else.
TEST(ContinuousCheckSettings, ABudgetOfOneStillMissesNothingAndStillExcludes) {
  CheckSettings settings;
  settings.maxIntervals = 1;
  QueryGenerator generator(3);
  for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
    for (int i = 0; i < 2000; ++i) {
      const int quarters = generator.integer(0, 4);
      const Query<double> query = generator.touching(pair, quarters);
      for (const Way& way : everyWay()) {
        const Contact contact = ask(way, pair, query, settings);
        EXPECT_TRUE(contact.found) << way.name << ": " << literal(pair, query);
        EXPECT_LE(contact.time, quarters / 4.0) << way.name << ": " << literal(pair, query);
        EXPECT_TRUE(whereInRange(pair, contact)) << way.name << ": " << literal(pair, query);
      }
    }
    int excluded = 0;
    for (int i = 0; i < 2000; ++i) {
      const Query<double> query = generator.uniform();
      const bool found = ContinuousCheck(Tier::conservative, settings)(pair, query).found;
      excluded += found ? 0 : 1;
      EXPECT_TRUE(found || !ContinuousCheck()(pair, query)) << literal(pair, query);
    }
    EXPECT_GT(excluded, 0);
  }
}

// The tolerance is where the search ends, so a contact excluded at a wide one is excluded at every smaller one.
TEST(ContinuousCheckSettings, ASmallerToleranceReportsNoEarlierTime) {
  CheckSettings wide;
  wide.tolerance = 0.25;
  CheckSettings narrow;
  narrow.tolerance = 1e-9;
  QueryGenerator generator(4);
  for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
    int later = 0;
    for (int i = 0; i < 2000; ++i) {
      const Query<double> query = generator.next<double>(QueryClass::cloth, pair);
      const Contact roughly = ContinuousCheck(Tier::conservative, wide)(pair, query);
      const Contact closely = ContinuousCheck(Tier::conservative, narrow)(pair, query);
      if (!closely.found) continue;
      EXPECT_TRUE(roughly.found) << literal(pair, query);
      EXPECT_LE(roughly.time, closely.time) << literal(pair, query);
      if (roughly.time < closely.time) ++later;
    }
    EXPECT_GT(later, 100);
  }
}

}  // namespace
}  // namespace wetcloth_test::continuous_check_settings_test
