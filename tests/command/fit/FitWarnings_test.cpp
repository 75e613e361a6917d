// SPDX-License-Identifier: Zlib
// Readings in a unit that is wrong by 1000 are warned of; right ones are not.

#include "command/fit/FitWarnings.h"
#include "command/fit/StripHeights.h"

#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <sstream>

namespace wetcloth_test::fit_warnings_test {
namespace {

/// Two columns of readings, and the law that they were made by.
struct Data {
  fit::MakeTask make;
  std::string columns;
  std::vector<double> x;
  std::vector<double> y;
  /// The law's values where both columns are that many times as much.
  std::function<std::vector<double>(double timesX, double timesY)> law;
};

Data soaking(const wetcloth::Fabric& fabric) {
  Data data{fit::absorptionTask, "time_s,water_kg_kg", {1, 3, 6, 10, 20, 30}, {}, {}};
  data.law = [=](double x, double y) { return std::vector<double>{fabric.capacity * y, fabric.timeConstant * x}; };
  for (const double t : data.x) data.y.push_back(fabric.capacity * -std::expm1(-t / fabric.timeConstant));
  return data;
}

/// Diffusivity and seepage of cotton, and of a knit (docs/fabrics.md, docs/reality.md).
Data wicking(double diffusivity, double speed) {
  Data data{fit::wickingTask, "time_s,height_m", {10, 30, 60, 180, 600}, {}, {}};
  data.law = [=](double x, double y) { return std::vector<double>{diffusivity * y * y / x, speed * y / x}; };
  data.y = fit::stripHeights({diffusivity, speed, 0.05}, data.x);
  return data;
}

/// @param rate  of loss [kg/kg/s]: of a shirt in a calm room, of a towel in the wind
Data drying(double rate) {
  Data data{fit::dryingTask, "time_s,water_kg_kg", {}, {}, {}};
  data.law = [=](double x, double y) { return std::vector<double>{0.8 * y, rate * y / x, 0.2 * y}; };
  for (int i = 0; i < 8; ++i) {
    data.x.push_back(i * 0.15 / rate);
    data.y.push_back(i < 5 ? 0.8 - 0.15 * i : 0.2 * std::exp(-(0.15 * i - 0.6) / 0.2));
  }
  return data;
}

/// @param stiffness  [N/m]: of a knit, of a woven one
Data stretch(double stiffness) {
  return {fit::stretchTask,
          "load_n_m,strain",
          {10, 20, 40},
          {10 / stiffness, 20 / stiffness, 40 / stiffness},
          [=](double x, double y) { return std::vector<double>{stiffness * x / y}; }};
}

/// What is warned of where a fit has found the law, with both columns in other units.
std::vector<std::string> warningsOf(const Data& data, double timesX = 1, double timesY = 1, bool hasConverged = true) {
  std::ostringstream text;
  text << data.columns << "\n";
  for (std::size_t i = 0; i < data.x.size(); ++i) text << data.x[i] * timesX << "," << data.y[i] * timesY << "\n";
  const cli::TemporaryDirectory directory;
  const command::MeasuredTable table(directory.write("data.csv", text.str()));
  const fit::Task task = data.make(table, wetcloth::Fabric::cotton());
  fit::Fit fit;
  for (const double value : data.law(timesX, timesY)) fit.estimates.push_back({value, value, 0, true, true, false});
  fit.model = task.readings.values;
  fit.hasConverged = hasConverged;
  return fit::warningsOf(task, fit);
}

void expectOneWarning(const std::vector<std::string>& warnings, const std::string& name) {
  ASSERT_EQ(warnings.size(), 1u) << name;
  EXPECT_EQ(warnings[0].rfind(name + " ", 0), 0u) << warnings[0];
  EXPECT_EQ(warnings[0].find('\n'), std::string::npos);
  EXPECT_NE(warnings[0].find("unit"), std::string::npos);
}

std::vector<Data> allRight() {
  return {soaking(wetcloth::Fabric::cotton()),
          soaking(wetcloth::Fabric::coarseWool()),
          soaking(wetcloth::Fabric::highAbsorption()),
          wicking(5e-6, 5e-5),
          wicking(4.1e-5, 8e-4),
          drying(2e-4),
          drying(5e-4),
          stretch(30),
          stretch(20000)};
}

TEST(FitWarnings, AreNoneOfReadingsInTheRightUnits) {
  for (const Data& data : allRight()) EXPECT_TRUE(warningsOf(data).empty()) << warningsOf(data).front();
}

TEST(FitWarnings, AreOneLineOfTimesInMillisecondsOrKiloseconds) {
  for (const Data& data : allRight()) {
    if (data.make == &fit::stretchTask) continue;
    for (const double factor : {1e3, 1e-3}) EXPECT_EQ(warningsOf(data, factor).size(), 1u) << data.columns << factor;
  }
}

TEST(FitWarnings, AreOneLineOfHeightsInMillimetres) {
  expectOneWarning(warningsOf(wicking(5e-6, 5e-5), 1, 1000), "height_m");
  expectOneWarning(warningsOf(wicking(5e-6, 5e-5), 1, 1e-3), "height_m");
}

TEST(FitWarnings, AreOneLineOfWaterInGramsPerKilogram) {
  for (const Data& data : {soaking(wetcloth::Fabric::cotton()), drying(2e-4)}) {
    expectOneWarning(warningsOf(data, 1, 1000), "water_kg_kg");
    expectOneWarning(warningsOf(data, 1, 1e-3), "water_kg_kg");
  }
}

TEST(FitWarnings, AreOneLineOfStrainsInPercentAndLoadsInAnotherUnit) {
  expectOneWarning(warningsOf(stretch(500), 1, 100), "strain");
  expectOneWarning(warningsOf(stretch(500), 1e-3, 1), "stiffness_n_m");
  expectOneWarning(warningsOf(stretch(20000), 1e3, 1), "stiffness_n_m");
}

TEST(FitWarnings, TellTheNumberItsRangeAndWhy) {
  const std::string warning = warningsOf(wicking(5e-6, 5e-5), 1, 1000).front();
  for (const char* const word : {"height_m reaches ", " 2 ", "pores"}) {
    EXPECT_NE(warning.find(word), std::string::npos) << word << " in " << warning;
  }
}

TEST(FitWarnings, SayThatASearchDidNotConverge) {
  const std::vector<std::string> warnings = warningsOf(stretch(500), 1, 1, false);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("did not converge"), std::string::npos);
}

}  // namespace
}  // namespace wetcloth_test::fit_warnings_test
