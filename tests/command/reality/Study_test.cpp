// SPDX-License-Identifier: Zlib
// Measurements that the model itself has made are met; a bias that is put into them is told.

#include "command/reality/Studies.h"
#include "command/reality/StudyReport.h"

#include "command/cli/Errors.h"

#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace wetcloth_test::reality_study_test {
namespace {

using reality::Plan;
using reality::Sample;
using reality::Study;

void tellNobody(double) {}

std::string measured(const std::string& name) {
  return std::string(WETCLOTH_SOURCE_DIR) + "/tests/data/measured/" + name + ".csv";
}

/// The plan with the model's own readings at this parameter in place of what was measured.
Plan madeByItself(Plan plan, double parameter) {
  for (std::vector<Sample>& samples : plan.groups) {
    for (Sample& sample : samples) sample.measured = sample.run(parameter);
  }
  return plan;
}

/// A plan of readings y = a x, of which the second half is predicted.
Plan proportional(double slopeOfFirst, double slopeOfSecond) {
  Plan plan;
  plan.parameter = "slope";
  plan.start = 1;
  Sample sample;
  for (int i = 1; i <= 8; ++i) {
    sample.at.push_back(i);
    sample.measured.push_back((i <= 4 ? slopeOfFirst : slopeOfSecond) * i);
    sample.uncertainty.push_back(0.5);
    sample.isFitted.push_back(i <= 4);
  }
  sample.run = [at = sample.at](double slope) {
    std::vector<double> values;
    for (const double x : at) values.push_back(slope * x);
    return values;
  };
  plan.groups = {{sample}};
  return plan;
}

TEST(RealityStudy, MeetsReadingsOfTheSameLaw) {
  const Study study = reality::carryOut(proportional(2, 2), tellNobody);
  EXPECT_EQ(study.fitted.readings, 4);
  EXPECT_EQ(study.predicted.readings, 4);
  // Where the search for the slope stops.
  EXPECT_LT(study.predicted.ofRange, 1e-5);
  EXPECT_EQ(reality::verdictOn(study), "The prediction is within the data's uncertainty.");
}

TEST(RealityStudy, TellsABias) {
  // The fit comes to 2, the later readings are 2.2 x: errors of 0.2 x 5 ... 8 against an uncertainty of 0.5, of a range
  // from 2 to 17.6.
  const Study study = reality::carryOut(proportional(2, 2.2), tellNobody);
  EXPECT_NEAR(study.groups[0].parameter.value, 2, 1e-5);
  EXPECT_NEAR(study.fitted.ofUncertainty, 0, 1e-4);
  const double rootMeanSquare = 0.2 * std::sqrt((25 + 36 + 49 + 64) / 4.);
  EXPECT_NEAR(study.predicted.rootMeanSquare, rootMeanSquare, 1e-4);
  EXPECT_NEAR(study.predicted.ofRange, rootMeanSquare / 15.6, 1e-5);
  EXPECT_NEAR(study.predicted.ofUncertainty, rootMeanSquare / 0.5, 1e-4);
  EXPECT_NEAR(study.predicted.bias, -0.2 * 6.5 / 15.6, 1e-5);
  EXPECT_NE(reality::verdictOn(study).find("wrong by 2.6 times"), std::string::npos) << reality::verdictOn(study);
}

TEST(RealityStudy, TellsNoStandardErrorOfWhatTheDataCannotTell) {
  Plan plan = proportional(2, 2);
  EXPECT_TRUE(reality::jsonOf(reality::carryOut(plan, tellNobody)).at("groups")[0].contains("standard_error"));
  for (double& uncertainty : plan.groups[0][0].uncertainty) uncertainty = 50;
  const nlohmann::ordered_json json = reality::jsonOf(reality::carryOut(plan, tellNobody)).at("groups")[0];
  EXPECT_EQ(json.at("is_told"), false);
  EXPECT_FALSE(json.contains("standard_error"));
}

TEST(RealityStudy, TellsThatASearchDidNotConverge) {
  Study study = reality::carryOut(proportional(2, 2), tellNobody);
  EXPECT_EQ(reality::jsonOf(study).at("groups")[0].at("converged"), true);
  EXPECT_EQ(reality::textOf(study).find("did not converge"), std::string::npos);
  study.groups[0].hasConverged = false;
  EXPECT_EQ(reality::jsonOf(study).at("groups")[0].at("converged"), false);
  EXPECT_NE(reality::textOf(study).find("did not converge"), std::string::npos);
}

// Whichever half of it was fitted.
TEST(RealityStudy, TheLineThatPredictsGoesOnWhereTheFittedOneEnds) {
  Plan plan = proportional(2, 2);
  plan.isOverTime = true;
  for (const bool isFirstFitted : {true, false}) {
    for (std::size_t i = 0; i < 8; ++i) plan.groups[0][0].isFitted[i] = (i < 4) == isFirstFitted;
    const command::Plot plot = reality::plotOf(reality::carryOut(plan, tellNobody));
    const std::vector<double>& fitted = plot.series[0].x;
    const std::vector<double>& predicted = plot.series[1].x;
    EXPECT_EQ(isFirstFitted ? fitted.back() : fitted.front(), isFirstFitted ? predicted.front() : predicted.back());
  }
}

TEST(RealityStudy, ModelsMeetWhatTheyHaveMade) {
  struct Case {
    Plan plan;
    double parameter;
  };
  const Case cases[] = {{reality::planAbsorption(measured("absorption_10s_handwoven_towels_2009")), 20},
                        {reality::planShirts(measured("drying_shirts_piotrowski")), 5e-5},
                        {reality::planTowels(measured("drying_towel_times_hut_2023")), 1.5e-4},
                        {reality::planSheet(measured("fall_a4_sheet_2013")), 1.5}};
  for (const Case& one : cases) {
    const Study study = reality::carryOut(madeByItself(one.plan, one.parameter), tellNobody);
    for (const reality::Group& group : study.groups) {
      EXPECT_NEAR(group.parameter.value, one.parameter, 1e-3 * one.parameter) << one.plan.name;
    }
    EXPECT_LT(study.predicted.ofUncertainty, 0.02) << one.plan.name;
  }
}

TEST(RealityStudy, AWettedStripMeetsWhatItHasMade) {
  Plan plan = reality::planWicking(measured("wicking_sock_knits_jasper_2025"));
  ASSERT_EQ(plan.groups.size(), 18u);
  // The shortest of them.
  plan.groups = {plan.groups[13]};
  const Study study = reality::carryOut(madeByItself(plan, 8e-5), tellNobody);
  // The front moves a little from row to row, which a search for the least error may stop at: 1 % of a row.
  EXPECT_NEAR(study.groups[0].parameter.value, 8e-5, 0.01 * 8e-5);
  EXPECT_LT(study.predicted.ofUncertainty, 0.1);
}

std::vector<std::string> linesOf(const std::string& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && line.front() != '#') lines.push_back(line);
  }
  return lines;
}

std::string textOf(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// Each reading with what goes with it, whatever sample it is in.
std::vector<std::string> readingsIn(const Plan& plan) {
  std::vector<std::string> readings;
  for (const std::vector<Sample>& samples : plan.groups) {
    for (const Sample& sample : samples) {
      for (std::size_t i = 0; i < sample.at.size(); ++i) {
        readings.push_back(sample.name + " " + std::to_string(sample.at[i]) + " " + std::to_string(sample.measured[i]) +
                           (sample.isFitted[i] ? " fitted" : " predicted"));
      }
    }
  }
  std::sort(readings.begin(), readings.end());
  return readings;
}

TEST(RealityStudy, FindsRowsInAnyOrder) {
  for (const reality::StudyEntry& entry : reality::studyEntries()) {
    std::vector<std::string> lines = linesOf(measured(entry.data));
    const std::vector<std::string> inOrder = readingsIn(entry.plan(measured(entry.data)));
    const cli::TemporaryDirectory directory;
    std::reverse(lines.begin() + 1, lines.end());
    EXPECT_EQ(readingsIn(entry.plan(directory.write("data.csv", textOf(lines)))), inOrder) << entry.name;
    std::sort(lines.begin() + 1, lines.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
    EXPECT_EQ(readingsIn(entry.plan(directory.write("data.csv", textOf(lines)))), inOrder) << entry.name;
  }
}

/// What the study says of its own file without the rows that begin so.
std::string complaintWithout(const std::string& begin, const std::string& study) {
  for (const reality::StudyEntry& entry : reality::studyEntries()) {
    if (entry.name != study) continue;
    std::vector<std::string> lines = linesOf(measured(entry.data));
    const auto begins = [&](const std::string& line) { return line.rfind(begin, 0) == 0; };
    lines.erase(std::remove_if(lines.begin() + 1, lines.end(), begins), lines.end());
    const cli::TemporaryDirectory directory;
    try {
      entry.plan(directory.write("data.csv", textOf(lines)));
    } catch (const command::InputError& error) {
      return error.what();
    }
  }
  return "no complaint";
}

TEST(RealityStudy, NamesTheRowsThatAreMissing) {
  const auto expect = [](const std::string& begin, const std::string& study, const std::vector<std::string>& words) {
    const std::string complaint = complaintWithout(begin, study);
    for (const std::string& word : words)
      EXPECT_NE(complaint.find(word), std::string::npos) << word << ": " << complaint;
  };
  expect("2,hema,", "towels", {"data.csv: has no rows", "run = \"2\"", "towel = \"hema\""});
  expect("0,", "sheet", {"folds = 0"});
  expect("1,", "sheet", {"folds > 0"});
  expect("material,", "streamers", {"has no rows", "series = \"material\""});
  expect("validation,", "streamers", {"has no rows", "series = \"validation\""});
  for (const reality::StudyEntry& entry : reality::studyEntries()) expect("", entry.name, {"data.csv: ", " row"});
}

TEST(RealityStudy, NamesTheClothThatHasTooFewRows) {
  // Nine rows of the first cloth, three of the second.
  std::vector<std::string> lines = linesOf(measured("wicking_sock_knits_jasper_2025"));
  lines.resize(1 + 9 + 3);
  const cli::TemporaryDirectory directory;
  try {
    reality::planWicking(directory.write("data.csv", textOf(lines)));
    FAIL() << "was taken";
  } catch (const command::InputError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("has 3 rows of readings with needles = \"108\", fibre = \"nylon\", knit = "
                        "\"flat\", series = \"OD\""),
              std::string::npos)
        << error.what();
  }
}

TEST(RealityStudy, RefusesTowelsThatItDoesNotKnowOrHasTwice) {
  const std::vector<std::string> lines = linesOf(measured("drying_towel_times_hut_2023"));
  const cli::TemporaryDirectory directory;
  for (const char* const more : {"1,ikea,0.025,0.0625,3000", "1,hema,0.025,0.0625,3000"}) {
    EXPECT_THROW(reality::planTowels(directory.write("data.csv", textOf(lines) + more)), command::InputError) << more;
  }
}

TEST(RealityStudy, SquaresFallAsTheClosedFormSays) {
  Plan plan = reality::planSquares(measured("fall_paper_squares_sypt_2016"));
  const Sample& squares = plan.groups[0][0];
  const std::vector<double> speeds = squares.run(0.005);
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    // sqrt(2 m g / (rho C A)); the run ends while it still grows by 1e-5 a step, some 1e-4 short.
    EXPECT_NEAR(speeds[i], std::sqrt(2 * 0.005 * 9.81 / (1.225 * 1.2 * squares.at[i])), 1e-3 * speeds[i]);
  }
}

}  // namespace
}  // namespace wetcloth_test::reality_study_test
