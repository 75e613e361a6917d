// SPDX-License-Identifier: Zlib
#include "command/fit/StripHeights.h"
#include "command/fit/Task.h"

#include "command/cli/Errors.h"

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <algorithm>

namespace fit {
namespace {

constexpr double longestOverFirst = 1000;

}  // namespace

Task wickingTask(const command::MeasuredTable& table, const wetcloth::Fabric& fabric) {
  using Allowed = command::MeasuredTable::Allowed;
  Task task;
  task.name = "wicking";
  task.law = "height of the front by Diffusion and Seepage";
  task.x = {"time_s", "time [s]"};
  task.y = {"height_m", "height of the front above the water [m]"};
  table.requireRows(3, "to fit 2 numbers");
  task.at = table.increasing("time_s", Allowed::positive);
  // The strip is run in steps of an eighth of the first time: a search would take hours.
  if (task.at.back() > longestOverFirst * task.at.front()) {
    throw command::InputError(table.file() + ": time_s of the last row must be at most 1000 times that of the first");
  }
  task.readings = readingsOf(table, "height_m", "height_sd_m");
  const double highest = *std::max_element(task.readings.values.begin(), task.readings.values.end());
  if (!(highest > 0)) throw command::InputError(table.file() + ": height_m is 0 in every row");
  const double seepage = wetcloth::Seepage::Parameters{}.speed;
  task.unknowns = {
      {"diffusivity_m2_s", highest * highest / task.at.back(), wetcloth::Diffusion::Parameters{}.warpDiffusivity},
      {"seepage_speed_m_s", seepage, seepage}};
  // 2 gamma / (rho g r) = 2 m for pores of r = 7 um; rho g r^2 / (8 mu) is 1e-6 to 1e-2 m/s for 1 to 90 um.
  task.ranges = {
      {"time_s", 0.1, 1e5, "strips are watched for seconds to a day"},
      {"height_m", 0.001, 2, "a front below 1 mm is not seen, and one above 2 m would need pores finer than 7 um"},
      {"diffusivity_m2_s", 2e-7, 2e-3,
       "water that spreads so slowly or so fast has not been seen in cloth (1e-6 to 1.4e-4)"},
      {"seepage_speed_m_s", 1e-6, 0.01, "water would run so by its weight in pores below 1 um or above 90 um"}};
  task.roughness = stripRoughness;
  task.curve = [highest](const std::vector<double>& unknowns, const std::vector<double>& times) {
    return stripHeights({unknowns[0], unknowns[1], highest}, times);
  };
  task.predict = [times = task.at, curve = task.curve](const std::vector<double>& unknowns) {
    return curve(unknowns, times);
  };
  task.cloth = [fabric](const std::vector<Estimate>& estimates) -> nlohmann::ordered_json {
    return {
        {"fabric", fabric.name},
        {"effects",
         {{"diffusion", {{"warp_diffusivity_m2_s", estimates[0].value}, {"weft_diffusivity_m2_s", estimates[0].value}}},
          {"seepage", {{"speed_m_s", estimates[1].value}}}}}};
  };
  return task;
}

}  // namespace fit
