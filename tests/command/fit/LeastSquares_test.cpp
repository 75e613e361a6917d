// SPDX-License-Identifier: Zlib
#include "command/fit/LeastSquares.h"

#include "command/cli/Errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace wetcloth_test::least_squares_test {
namespace {

const std::vector<double>& places() {
  static const std::vector<double> all{1, 2, 3, 4, 5, 6, 7, 8};
  return all;
}

/// y = a x^b
std::vector<double> powerLaw(const std::vector<double>& unknowns) {
  std::vector<double> values;
  for (const double x : places()) values.push_back(unknowns[0] * std::pow(x, unknowns[1]));
  return values;
}

const std::vector<fit::Unknown>& unknowns() {
  static const std::vector<fit::Unknown> both{{"a", 1, 1}, {"b", 1, 1}};
  return both;
}

TEST(LeastSquares, FindsWhatTheReadingsWereMadeOf) {
  const fit::Fit fit = fit::fitLeastSquares(unknowns(), powerLaw, {powerLaw({3.5, 0.4}), {}});
  // The search ends when it moves by 1e-5, and is nearer than that by then.
  EXPECT_NEAR(fit.estimates[0].value, 3.5, 1e-5);
  EXPECT_NEAR(fit.estimates[1].value, 0.4, 1e-5);
  EXPECT_TRUE(fit.estimates[0].isTold() && fit.estimates[1].isTold());
}

TEST(LeastSquares, StandardErrorOfAMeanIsThatOfTextbooks) {
  const std::vector<double> readings{9, 11, 10, 12, 8, 10};
  const auto mean = [&](const std::vector<double>& value) { return std::vector<double>(readings.size(), value[0]); };
  const fit::Fit free = fit::fitLeastSquares({{"mean", 5, 5}}, mean, {readings, {}});
  EXPECT_NEAR(free.estimates[0].value, 10, 1e-5);
  // sqrt(sum of squares 10 / (5 degrees of freedom) / 6 readings); the difference quotient is good to its step squared.
  EXPECT_NEAR(free.estimates[0].standardError, std::sqrt(2. / 6), 1e-4);
  const fit::Fit stated = fit::fitLeastSquares({{"mean", 5, 5}}, mean, {readings, std::vector<double>(6, 3)});
  EXPECT_NEAR(stated.estimates[0].standardError, 3 / std::sqrt(6), 1e-3);
  EXPECT_NEAR(stated.reducedChiSquared, 10. / 9 / 5, 1e-6);
}

TEST(LeastSquares, TwoOfThreeFitsAreWithinOneStandardError) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.05);
  int within[2] = {0, 0};
  constexpr int fits = 50;
  for (int i = 0; i < fits; ++i) {
    std::vector<double> readings = powerLaw({2, 0.5});
    for (double& reading : readings) reading += noise(random);
    const fit::Fit fit = fit::fitLeastSquares(unknowns(), powerLaw, {readings, std::vector<double>(8, 0.05)});
    within[0] += std::fabs(fit.estimates[0].value - 2) < fit.estimates[0].standardError;
    within[1] += std::fabs(fit.estimates[1].value - 0.5) < fit.estimates[1].standardError;
  }
  // 68 % of 50 with a deviation of 3.3; errors that were scaled up by unlucky chi squared make it a little more.
  for (const int count : within) {
    EXPECT_GT(count, 24);
    EXPECT_LT(count, 46);
  }
}

TEST(LeastSquares, SaysOfWhatDoesNothingThatItIsNotTold) {
  const auto onlyFirst = [](const std::vector<double>& values) { return powerLaw({values[0], 0.5}); };
  const fit::Fit fit = fit::fitLeastSquares({{"a", 1, 1}, {"idle", 1, 7}}, onlyFirst, {powerLaw({2, 0.5}), {}});
  EXPECT_NEAR(fit.estimates[0].value, 2, 1e-5);
  EXPECT_TRUE(fit.estimates[0].isTold());
  EXPECT_FALSE(fit.estimates[1].isNotLess || fit.estimates[1].isNotMore);
  EXPECT_TRUE(fit.estimates[1].isUsual);
  EXPECT_EQ(fit.estimates[1].value, 7);
  EXPECT_EQ(fit.estimates[1].standardError, 0);
}

TEST(LeastSquares, OfAProductOneFactorIsTakenAsUsual) {
  const auto product = [](const std::vector<double>& values) { return powerLaw({values[0] * values[1], 0.5}); };
  const fit::Fit fit = fit::fitLeastSquares({{"a", 1, 4}, {"b", 1, 4}}, product, {powerLaw({2, 0.5}), {}});
  EXPECT_NE(fit.estimates[0].isTold(), fit.estimates[1].isTold());
  EXPECT_NEAR(fit.estimates[0].value * fit.estimates[1].value, 2, 1e-4);
  EXPECT_TRUE(fit.estimates[0].value == 4 || fit.estimates[1].value == 4);
}

// Two readings 20 % apart leave their mean, 1.1 +- 0.1, anywhere within 12.7 of these errors, six of them within 2.6.
TEST(LeastSquares, FewReadingsDoNotTellTheirScatter) {
  for (const std::size_t count : {std::size_t(2), std::size_t(6)}) {
    std::vector<double> readings(count, 1);
    for (std::size_t i = 1; i < count; i += 2) readings[i] = 1.2;
    const auto mean = [&](const std::vector<double>& value) { return std::vector<double>(count, value[0]); };
    EXPECT_EQ(fit::fitLeastSquares({{"mean", 1, 1}}, mean, {readings, {}}).estimates[0].isTold(), count == 6);
    EXPECT_TRUE(fit::fitLeastSquares({{"mean", 1, 1}}, mean, {readings, std::vector<double>(count, 0.1)})
                    .estimates[0]
                    .isTold());
  }
}

// Each of two usual values is (0.5 / 0.3)^2 = 2.8 of chi squared away, both together 5.6.
TEST(LeastSquares, UsualValuesTogetherFitNoWorseThanOneMay) {
  const auto both = [](const std::vector<double>& values) { return std::vector<double>{values[0], values[1], 5}; };
  const fit::Fit fit =
      fit::fitLeastSquares({{"a", 1, 1.5}, {"b", 1, 1.5}}, both, {{1, 1, 5}, std::vector<double>(3, 0.3)});
  EXPECT_FALSE(fit.estimates[0].isTold() || fit.estimates[1].isTold());
  EXPECT_NE(fit.estimates[0].isUsual, fit.estimates[1].isUsual);
}

// Towards a root of high order each step covers a share of what is left: Newton's method is linear there.
TEST(LeastSquares, SaysWhetherItConverged) {
  EXPECT_TRUE(fit::fitLeastSquares(unknowns(), powerLaw, {powerLaw({3.5, 0.4}), {}}).hasConverged);
  const auto flat = [](const std::vector<double>& values) {
    return std::vector<double>(2, std::pow(std::log(values[0]), 40));
  };
  EXPECT_FALSE(fit::fitLeastSquares({{"a", 20, 20}}, flat, {{0, 0}, {}}).hasConverged);
}

TEST(LeastSquares, AsksForMoreReadingsThanUnknowns) {
  const auto two = [](const std::vector<double>& values) { return values; };
  EXPECT_THROW(fit::fitLeastSquares(unknowns(), two, {{1, 2}, {}}), command::InputError);
  try {
    fit::fitLeastSquares({{"a", 1, 1}}, two, {{1}, {}});
    FAIL() << "was taken";
  } catch (const command::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("1 number cannot be fitted to 1 reading,"), std::string::npos)
        << error.what();
  }
}

TEST(LeastSquares, SaysWhenTheModelIsNotFinite) {
  const auto none = [](const std::vector<double>&) { return std::vector<double>(8, std::nan("")); };
  EXPECT_THROW(fit::fitLeastSquares(unknowns(), none, {powerLaw({1, 1}), {}}), command::RunError);
}

TEST(LeastSquares, SaysWhenChiSquaredIsNotFinite) {
  EXPECT_THROW(fit::fitLeastSquares(unknowns(), powerLaw, {powerLaw({2, 2}), std::vector<double>(8, 1e-200)}),
               command::RunError);
}

}  // namespace
}  // namespace wetcloth_test::least_squares_test
