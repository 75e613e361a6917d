// SPDX-License-Identifier: Zlib
// Readings made by a known model with known noise give the model back.

#include "command/fit/DryingAir.h"
#include "command/fit/StripHeights.h"
#include "command/fit/Task.h"

#include "command/cli/Errors.h"

#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

namespace wetcloth_test::fit_tasks_test {
namespace {

using fit::Estimate;
using fit::Fit;
using fit::Task;

/// A law over times, with noise of this deviation, as a file.
template <class Law>
std::string series(const std::string& column, double until, int count, double noise, Law law) {
  std::mt19937 random(7);
  std::normal_distribution<double> deviate(0, noise);
  std::ostringstream text;
  text << "time_s," << column << "\n";
  for (int i = 1; i <= count; ++i) {
    const double time = until * i / count;
    text << time << "," << std::max(0.0, law(time) + deviate(random)) << "\n";
  }
  return text.str();
}

Task taskOf(fit::MakeTask make, const std::string& text) {
  const cli::TemporaryDirectory directory;
  return make(command::MeasuredTable(directory.write("data.csv", text)), wetcloth::Fabric::cotton());
}

Fit fitOf(const Task& task) { return fit::fitLeastSquares(task.unknowns, task.predict, task.readings, task.roughness); }

/// Three standard errors: one good fit of 370 misses it, and this is one that does not.
void expectNear(const Estimate& estimate, double truth) {
  EXPECT_TRUE(estimate.isTold());
  EXPECT_GT(estimate.standardError, 0);
  EXPECT_NEAR(estimate.value, truth, 3 * estimate.standardError);
}

double soaked(double time) { return 1.2 * -std::expm1(-time / 6); }

/// 0.7 kg/kg that lose 2e-4 kg/kg/s, below 0.2 kg/kg in proportion.
double dried(double time) {
  const double constant = 0.5 / 2e-4;
  return time < constant ? 0.7 - 2e-4 * time : 0.2 * std::exp(-(time - constant) * 2e-4 / 0.2);
}

TEST(AbsorptionTask, GivesBackCapacityAndTimeConstant) {
  const Fit fit = fitOf(taskOf(fit::absorptionTask, series("water_kg_kg", 30, 15, 0.01, soaked)));
  expectNear(fit.estimates[0], 1.2);
  expectNear(fit.estimates[1], 6);
}

TEST(AbsorptionTask, SaysThatTheBeginningDoesNotTellBoth) {
  const Fit fit = fitOf(taskOf(fit::absorptionTask, series("water_kg_kg", 1, 10, 0.005, soaked)));
  EXPECT_FALSE(fit.estimates[0].isTold() && fit.estimates[1].isTold());
  // Their ratio is what it tells, to 5 %: noise of 0.005 in ten readings of up to 0.18, and the curve not quite
  // straight.
  EXPECT_NEAR(fit.estimates[0].value / fit.estimates[1].value, 0.2, 0.01);
}

TEST(DryingTask, GivesBackRateAndCriticalWater) {
  const Fit fit = fitOf(taskOf(fit::dryingTask, series("water_kg_kg", 6000, 20, 0.005, dried)));
  expectNear(fit.estimates[0], 0.7);
  expectNear(fit.estimates[1], 2e-4);
  expectNear(fit.estimates[2], 0.2);
}

TEST(DryingTask, SaysThatTheConstantRateDoesNotTellTheCriticalWater) {
  const Fit fit = fitOf(taskOf(fit::dryingTask, series("water_kg_kg", 2400, 12, 0.005, dried)));
  expectNear(fit.estimates[1], 2e-4);
  EXPECT_FALSE(fit.estimates[2].isTold());
  EXPECT_FALSE(fit.estimates[2].isNotLess) << "any lower value does as well";
}

TEST(DryingTask, ItsAirDriesAtThatRate) {
  for (const double rate : {1e-6, 3e-5, 1e-4, 1e-3}) {  // [kg/m^2/s]: a sheltered place to a storm
    const wetcloth::Drying::Parameters air = fit::airThatDries(rate);
    const auto speed = static_cast<double>(air.air.at(btVector3(0, 0, 0), 0).length());
    // The speed of the wind is a btScalar.
    EXPECT_NEAR(air.sides * air.selfCooling * wetcloth::evaporationRate(air.temperature, air.relativeHumidity, speed),
                rate, 1e-6 * rate);
  }
}

// With 2 kg/kg it would be critical above what cotton holds, 0.84 kg/kg: less water falls in proportion all the time.
TEST(DryingTask, ItsClothFallsAsFastWhereTheCriticalWaterIsMoreThanItHolds) {
  const Task task = taskOf(fit::dryingTask, series("water_kg_kg", 6000, 20, 0, dried));
  std::vector<Estimate> estimates(3);
  estimates[0].value = 0.7;
  estimates[1].value = 2e-3;
  estimates[2].value = 2;
  const nlohmann::ordered_json drying = task.cloth(estimates).at("effects").at("drying");
  EXPECT_EQ(drying.at("critical_saturation"), 1);
  const wetcloth::Fabric cotton = wetcloth::Fabric::cotton();
  const wetcloth::Drying::Parameters air;
  const double rate =
      air.sides * drying.at("self_cooling").get<double>() *
      wetcloth::evaporationRate(air.temperature, air.relativeHumidity, drying.at("velocity_m_s").at(0).get<double>());
  // The speed of the wind is a btScalar.
  EXPECT_NEAR(rate / (cotton.capacity * cotton.arealDensity), 2e-3 / 2, 1e-8);
}

TEST(StretchTask, GivesBackStiffnessDryAndWet) {
  const Task task =
      taskOf(fit::stretchTask,
             "load_n_m,strain,saturation\n10,0.0101,0\n20,0.0198,0\n40,0.0402,0\n10,0.0201,1\n20,0.0398,1\n"
             "40,0.0799,1\n");
  const Fit fit = fitOf(task);
  expectNear(fit.estimates[0], 1000);
  expectNear(fit.estimates[1], 0.5);
}

TEST(WickingTask, GivesBackTheDiffusivity) {
  std::ostringstream text;
  text << "time_s,height_m\n";
  const std::vector<double> times{5, 10, 20, 40};
  const std::vector<double> heights = fit::stripHeights({2e-5, 5e-5, 0.04}, times);
  for (std::size_t i = 0; i < times.size(); ++i) text << times[i] << "," << heights[i] << "\n";
  const Task task = taskOf(fit::wickingTask, text.str());
  const fit::Predict byDiffusivity = [&](const std::vector<double>& unknowns) {
    return task.predict({unknowns[0], 5e-5});
  };
  const Fit fit = fit::fitLeastSquares({task.unknowns[0]}, byDiffusivity, task.readings, task.roughness);
  // The strip that is fitted is not as long as the other one, and its rows are elsewhere: 1 % of it each.
  EXPECT_NEAR(fit.estimates[0].value, 2e-5, 0.05 * 2e-5);
}

TEST(StripHeights, RiseAsTheRootOfTimeAtFirst) {
  const std::vector<double> heights = fit::stripHeights({2e-5, 0, 0.06}, {10, 40});
  EXPECT_NEAR(heights[1] / heights[0], 2, 0.06) << "a row is 3 % of the lower height";
  // x = 1.0880 sqrt(D t) at a saturation of 0.05, and 1.7 % more where it is 0: s^2 is linear there.
  EXPECT_NEAR(heights[1], 1.09 * std::sqrt(2e-5 * 40), 0.04 * heights[1]);
}

TEST(FitTasks, RefuseWhatTheyCannotUse) {
  using command::InputError;
  EXPECT_THROW(taskOf(fit::absorptionTask, "time_s,water_kg_kg\n0,0\n1,0.1\n"), InputError) << "too few";
  EXPECT_THROW(taskOf(fit::absorptionTask, "time_s,water_kg_kg\n0,0\n1,0\n2,0\n"), InputError) << "no water";
  EXPECT_THROW(taskOf(fit::absorptionTask, "time_s,water_kg_kg\n0,0\n2,1\n1,1\n"), InputError) << "back in time";
  EXPECT_THROW(taskOf(fit::dryingTask, "time_s,water_kg_kg\n0,0\n1,0\n2,0\n3,0\n"), InputError) << "dry";
  EXPECT_THROW(taskOf(fit::wickingTask, "time_s,height_m\n0,0\n1,0.1\n2,0.2\n"), InputError) << "at time 0";
  EXPECT_THROW(taskOf(fit::wickingTask, "time_s,height_m\n1,0.01\n60,0.1\n86400,0.2\n"), InputError) << "too long";
  EXPECT_THROW(taskOf(fit::stretchTask, "load_n_m,strain\n1,0\n2,0\n"), InputError) << "rigid";
  EXPECT_THROW(taskOf(fit::stretchTask, "load_n_m,strain,saturation\n1,1,0\n2,2,1.5\n3,3,1\n"), InputError);
  EXPECT_THROW(taskOf(fit::absorptionTask, "time_s,water_kg_kg,water_sd_kg_kg\n0,0,0\n1,1,1\n2,1,1\n"), InputError);
}

}  // namespace
}  // namespace wetcloth_test::fit_tasks_test
