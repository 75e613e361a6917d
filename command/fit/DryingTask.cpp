// SPDX-License-Identifier: Zlib
#include "command/fit/DryingAir.h"
#include "command/fit/Task.h"

#include "command/cli/Errors.h"

#include <algorithm>

namespace fit {
namespace {

// Of the unknowns.
constexpr std::size_t initial = 0, rate = 1, critical = 2;

std::vector<double> dried(const std::vector<double>& unknowns, const std::vector<double>& times) {
  std::vector<double> water;
  for (const double time : times) {
    water.push_back(unknowns[initial] -
                    wetcloth::dryingStep(unknowns[initial], unknowns[critical], unknowns[rate], time));
  }
  return water;
}

/// Rate at which the first half of the loss went [1/s].
double firstRate(const Task& task) {
  const std::vector<double>& water = task.readings.values;
  const double halfway = (water.front() + water.back()) / 2;
  std::size_t i = 1;
  while (i + 1 < water.size() && water[i] > halfway) ++i;
  return std::max(water.front() - water[i], 1e-3 * water.front()) / (task.at[i] - task.at.front());
}

nlohmann::ordered_json dryingCloth(const wetcloth::Fabric& fabric, const std::vector<Estimate>& estimates) {
  const double most = estimates[initial].value;
  const double capacity = std::max(fabric.capacity, most);
  // Below the critical water only rate over critical water matters, and a cloth holds no more than its capacity.
  const double shareOfRate = std::min(1.0, capacity / estimates[critical].value);
  const wetcloth::Drying::Parameters air = airThatDries(shareOfRate * estimates[rate].value * fabric.arealDensity);
  nlohmann::ordered_json drying;
  drying["self_cooling"] = air.selfCooling;
  const auto speed = static_cast<double>(air.air.at(btVector3(0, 0, 0), 0).length());
  if (speed > 0) drying["velocity_m_s"] = {speed, 0, 0};
  drying["critical_saturation"] = std::min(1.0, estimates[critical].value / capacity);
  return {{"fabric", {{"preset", fabric.name}, {"name", "fitted"}, {"capacity_kg_per_kg", capacity}}},
          {"initial_saturation", most / capacity},
          {"effects", {{"drying", drying}}}};
}

}  // namespace

Task dryingTask(const command::MeasuredTable& table, const wetcloth::Fabric& fabric) {
  Task task;
  task.name = "drying";
  task.law = "d water / d time = -rate, below the critical water -rate water / critical";
  task.x = {"time_s", "time [s]"};
  task.y = {"water_kg_kg", "water over dry mass [kg/kg]"};
  table.requireRows(4, "to fit 3 numbers");
  task.at = table.increasing("time_s");
  task.readings = readingsOf(table, "water_kg_kg", "water_sd_kg_kg");
  if (!(task.readings.values.front() > 0)) throw command::InputError(table.file() + ": the cloth must be wet at first");
  const double usualCritical = wetcloth::Drying::Parameters{}.criticalSaturation * fabric.capacity;
  const double start = task.readings.values.front();
  const double first = firstRate(task);
  const double usualRate =
      wetcloth::Drying::Parameters{}.selfCooling * 2 * wetcloth::evaporationRate(20, 0.5, 0) / fabric.arealDensity;
  task.unknowns = {{"initial_water_kg_kg", start, fabric.capacity},
                   {"rate_kg_kg_s", first, usualRate},
                   {"critical_water_kg_kg", start / 3, usualCritical}};
  task.ranges = {
      {"time_s", 10, 1e6, "cloth dries in minutes to days"},
      {"water_kg_kg", 0.01, 40, "cloth holds 0.4 (polyester) to 4 (terry) times its mass of water, fleece up to 40"},
      {"rate_kg_kg_s", 1e-6, 0.01, "its own mass of water leaves a cloth in minutes to days"}};
  task.curve = dried;
  task.predict = [times = task.at](const std::vector<double>& unknowns) { return dried(unknowns, times); };
  task.cloth = [fabric](const std::vector<Estimate>& estimates) { return dryingCloth(fabric, estimates); };
  return task;
}

}  // namespace fit
