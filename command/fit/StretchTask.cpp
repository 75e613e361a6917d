// SPDX-License-Identifier: Zlib
#include "command/fit/Task.h"

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <algorithm>

namespace fit {
namespace {

/// Stiffness of a strip over that of its links: a square mesh of links K along its edges and K along both diagonals of
/// its squares, free to grow narrow. C11 = 2 K, C12 = K, and C11 - C12^2 / C11 is left.
constexpr double stripOverLinks = 1.5;

double usualStiffness() { return stripOverLinks * wetcloth::HookeSprings::Parameters{}.stiffness; }

std::vector<double> saturationsOf(const command::MeasuredTable& table) {
  if (!table.has("saturation")) return std::vector<double>(table.rows(), 0);
  std::vector<double> saturations = table.numbers("saturation", command::MeasuredTable::Allowed::notNegative);
  for (std::size_t i = 0; i < saturations.size(); ++i) {
    if (saturations[i] > 1) table.reject(i, "saturation", "must be in [0, 1]");
  }
  return saturations;
}

}  // namespace

Task stretchTask(const command::MeasuredTable& table, const wetcloth::Fabric& fabric) {
  using Allowed = command::MeasuredTable::Allowed;
  Task task;
  task.name = "stretch";
  task.law = "strain = load / (stiffness (1 + (wet stretch - 1) saturation))";
  task.x = {"load_n_m", "load over width [N/m]"};
  task.y = {"strain", "strain [-]"};
  const std::vector<double> saturations = saturationsOf(table);
  const bool isWet = std::any_of(saturations.begin(), saturations.end(), [](double s) { return s > 0; });
  table.requireRows(isWet ? 3 : 2, isWet ? "to fit 2 numbers" : "to fit 1 number");
  task.at = table.numbers("load_n_m", Allowed::positive);
  task.readings = readingsOf(table, "strain", "strain_sd");
  const auto most = std::max_element(task.readings.values.begin(), task.readings.values.end());
  if (!(*most > 0)) table.reject(0, "strain", "is 0, as in every row");
  const double load = task.at[static_cast<std::size_t>(most - task.readings.values.begin())];
  task.unknowns = {{"stiffness_n_m", load / *most, usualStiffness()}};
  task.ranges = {{"load_n_m", 1e-3, 1e6, "1e6 N/m would tear any cloth, 1e-3 N/m is less than its own weight"},
                 {"strain", 1e-5, 3, "cloth tears before it is four times as long; a strain is no percentage"},
                 {"stiffness_n_m", 10, 1e7,
                  "at 10 N/m a metre of cloth would stretch by 7 % of its own weight, 1e7 N/m is glass"}};
  const double usualWet = wetcloth::WetStiffness::Parameters{}.wetStretch;
  if (isWet) task.unknowns.push_back({"wet_stretch", usualWet, usualWet});
  task.predict = [loads = task.at, saturations, isWet](const std::vector<double>& unknowns) {
    std::vector<double> strains;
    for (std::size_t i = 0; i < loads.size(); ++i) {
      const double softer = isWet ? 1 + (unknowns[1] - 1) * saturations[i] : 1;
      strains.push_back(loads[i] / (unknowns[0] * softer));
    }
    return strains;
  };
  task.cloth = [fabric, isWet](const std::vector<Estimate>& estimates) -> nlohmann::ordered_json {
    nlohmann::ordered_json effects;
    effects["hooke_springs"] = {{"stiffness_n_m", estimates[0].value / stripOverLinks}, {"bending_stiffness_n_m", 0}};
    if (isWet) effects["wet_stiffness"] = {{"wet_stretch", estimates[1].value}};
    return {{"fabric", fabric.name}, {"effects", effects}};
  };
  return task;
}

}  // namespace fit
