// SPDX-License-Identifier: Zlib
#include "command/fit/Task.h"

#include "command/cli/Errors.h"

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <algorithm>

namespace fit {
namespace {

std::vector<double> soaked(const std::vector<double>& unknowns, const std::vector<double>& times) {
  std::vector<double> water;
  for (const double time : times) water.push_back(unknowns[0] * wetcloth::exponentialShare(time / unknowns[1]));
  return water;
}

/// When the cloth has taken up two thirds of the most that was measured [s].
double timeOfTwoThirds(const Task& task, double most) {
  std::size_t i = 0;
  while (task.readings.values[i] < 2 * most / 3) ++i;
  return std::max(task.at[i], task.at.back() / 1000);
}

}  // namespace

Task absorptionTask(const command::MeasuredTable& table, const wetcloth::Fabric& fabric) {
  Task task;
  task.name = "absorption";
  task.law = "water = capacity (1 - exp(-time / time constant))";
  task.x = {"time_s", "time [s]"};
  task.y = {"water_kg_kg", "water over dry mass [kg/kg]"};
  table.requireRows(3, "to fit 2 numbers");
  task.at = table.increasing("time_s");
  task.readings = readingsOf(table, "water_kg_kg", "water_sd_kg_kg");
  const double most = *std::max_element(task.readings.values.begin(), task.readings.values.end());
  if (!(most > 0)) throw command::InputError(table.file() + ": water_kg_kg is 0 in every row");
  task.unknowns = {{"capacity_kg_per_kg", most, fabric.capacity},
                   {"time_constant_s", timeOfTwoThirds(task, most), fabric.timeConstant}};
  task.ranges = {
      {"time_s", 0.01, 1e5, "cloth that soaks is full in seconds, at most in a day"},
      {"water_kg_kg", 0.01, 40, "cloth holds 0.4 (polyester) to 4 (terry) times its mass of water, fleece up to 40"},
      {"time_constant_s", 0.01, 1000, "scoured cotton soaks in tenths of a second, greige in many minutes"}};
  task.curve = soaked;
  task.predict = [times = task.at](const std::vector<double>& unknowns) { return soaked(unknowns, times); };
  task.cloth = [fabric](const std::vector<Estimate>& estimates) -> nlohmann::ordered_json {
    return {{"fabric",
             {{"preset", fabric.name},
              {"name", "fitted"},
              {"capacity_kg_per_kg", estimates[0].value},
              {"time_constant_s", estimates[1].value}}}};
  };
  return task;
}

}  // namespace fit
