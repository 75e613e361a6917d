// SPDX-License-Identifier: Zlib
// Measurements that the model itself has made are met; a bias that is put into them is told.

#include "command/reality/Studies.h"
#include "command/reality/StudyReport.h"

#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <cmath>

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
