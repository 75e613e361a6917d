// SPDX-License-Identifier: Zlib
#include "command/reality/FallingSheet.h"
#include "command/reality/Studies.h"

#include "command/cli/Errors.h"

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <algorithm>
#include <cmath>

namespace reality {
namespace {

constexpr double paperDensity = 0.080;       // the usual A4 paper [kg/m^2]
constexpr double sheetArea = 0.210 * 0.297;  // [m^2]
constexpr double timerDoubt = 0.2;           // by hand [s]
constexpr double timeDoubt = 0.05 / 1.1;     // of the time: some 5 % of the height

void requireFlatAndFolded(const command::MeasuredTable& table, const std::vector<double>& folds) {
  const auto flat = std::count(folds.begin(), folds.end(), 0.0);
  if (flat == 0) throw command::InputError(table.file() + ": must have a row with folds = 0, the sheet to predict");
  if (static_cast<std::ptrdiff_t>(folds.size()) - flat >= 2) return;
  throw command::InputError(table.file() + ": must have at least 2 rows with folds > 0, to fit 1 number");
}

}  // namespace

Plan planSheet(const std::string& file) {
  using Allowed = command::MeasuredTable::Allowed;
  const command::MeasuredTable table(file);
  Plan plan;
  plan.name = "sheet";
  plan.title = "Time of fall of a sheet of A4 paper, flat and folded";
  plan.model = "Wind in still air; a sheet of 80 g/m2, folded once and twice, falls level";
  plan.halves = "the folded sheets are fitted, the flat one predicted";
  plan.doubt = "0.2 s of a timer by hand, 5 % of the height";
  plan.x = {"folds", "folds"};
  plan.y = {"time_s", "time of fall [s]"};
  plan.parameter = "drag_coefficient";
  plan.start = wetcloth::Wind::Parameters{}.dragCoefficient;
  Sample sheets;
  sheets.name = "paper";
  sheets.at = table.numbers("folds", Allowed::notNegative);
  requireFlatAndFolded(table, sheets.at);
  sheets.measured = table.numbers("time_s", Allowed::positive);
  const std::vector<double> heights = table.numbers("height_m", Allowed::positive);
  for (std::size_t i = 0; i < sheets.at.size(); ++i) {
    sheets.uncertainty.push_back(std::hypot(timerDoubt, timeDoubt * sheets.measured[i]));
    sheets.isFitted.push_back(sheets.at[i] > 0);
  }
  sheets.run = [folds = sheets.at, heights](double dragCoefficient) {
    std::vector<double> times;
    for (std::size_t i = 0; i < folds.size(); ++i) {
      const double layers = std::exp2(folds[i]);
      times.push_back(fallTimeOf({sheetArea / layers, paperDensity * layers, dragCoefficient}, heights[i]));
    }
    return times;
  };
  plan.groups = {{sheets}};
  return plan;
}

}  // namespace reality
