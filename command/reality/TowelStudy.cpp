// SPDX-License-Identifier: Zlib
#include "command/reality/DryingCloth.h"
#include "command/reality/Studies.h"

#include "command/cli/NearestWord.h"

#include <algorithm>

namespace reality {
namespace {

/// The mark of the measurement: of some 5 K by which a wet piece is cooler, 2 K are left. So is the rate.
constexpr double shareOfRateWhenDry = 0.4;
constexpr double sideBySide = 0.12;               // of towels of one run in a plot
constexpr double terryCriticalSaturation = 0.15;  // docs/fabrics.md

/// When a piece of towel is dry by that mark [s].
double timeToDry(double water, double area, double rate) {
  constexpr double steps = 400;  // in which it would be dry if the rate did not fall
  DryingCloth::Settings settings;
  settings.fabric = wetcloth::Fabric::highAbsorption();
  settings.area = area;
  settings.water = water;
  settings.rate = rate;
  settings.criticalSaturation = terryCriticalSaturation;
  DryingCloth towel(settings);
  const double step = water / (area * rate) / steps;
  double before = 1, share = 1;  // of the rate, in the middle of the last two steps
  while (share > shareOfRateWhenDry) {
    const double held = towel.water();
    towel.advance(step);
    before = share;
    share = (held - towel.water()) / (water / steps);
  }
  return towel.time() - step * (1.5 - (before - shareOfRateWhenDry) / (before - share));
}

/// The mark of 2 K against 1 K moves the time of cotton by several minutes, of the others by one or two [s].
double doubtOf(const std::string& towel) { return towel == "cotton" ? 240 : 90; }

/// The rate is fitted to the first three; the others are predicted.
const std::vector<std::string>& towelNames() {
  static const std::vector<std::string> names{"decathlon", "hema", "care_plus", "anwb", "xenos", "cotton"};
  return names;
}
constexpr std::size_t fittedTowels = 3;

void requireKnownTowels(const command::MeasuredTable& table) {
  const std::vector<std::string> words = table.words("towel");
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto& known = towelNames();
    if (std::find(known.begin(), known.end(), words[i]) != known.end()) continue;
    table.reject(i, "towel", "must be one of " + command::joined(known));
  }
}

/// The one row of a towel in a run.
command::MeasuredTable rowOf(const command::MeasuredTable& run, const std::string& towel) {
  command::MeasuredTable row = run.where("towel", towel);
  row.requireRows(1, "of each towel in each run");
  if (row.rows() > 1) row.reject(1, "towel", "is there twice in this run");
  return row;
}

Sample towelOf(const command::MeasuredTable& row, std::size_t place) {
  using Allowed = command::MeasuredTable::Allowed;
  const auto only = [&](const char* column) { return row.numbers(column, Allowed::positive).front(); };
  const std::string& name = towelNames()[place];
  Sample towel;
  towel.name = "run " + row.words("run").front() + " " + name;
  towel.at = {only("run") + sideBySide * static_cast<double>(place)};
  towel.measured = {only("dry_s")};
  towel.uncertainty = {doubtOf(name)};
  towel.isFitted = {place < fittedTowels};
  towel.run = [water = only("water_kg"), area = only("area_m2")](double rate) {
    return std::vector<double>{timeToDry(water, area, rate)};
  };
  return towel;
}

std::vector<Sample> towelsOf(const command::MeasuredTable& run) {
  std::vector<Sample> towels;
  for (std::size_t i = 0; i < towelNames().size(); ++i) towels.push_back(towelOf(rowOf(run, towelNames()[i]), i));
  return towels;
}

}  // namespace

Plan planTowels(const std::string& file) {
  const command::MeasuredTable table = command::MeasuredTable(file).sortedBy("run");
  table.requireRows(1, "to fit and predict");
  requireKnownTowels(table);
  Plan plan;
  plan.name = "towels";
  plan.title = "Time until wetted pieces of six towels are dry";
  plan.model =
      "Drying of Fabric::highAbsorption() with the critical saturation of terry, 0.15, until its rate is at 0.4";
  plan.halves =
      "of each run, which has a weather of its own, decathlon, hema and care_plus are fitted, the rest predicted";
  plan.doubt = "90 s, of cotton 240 s: what the author's mark of dryness is worth";
  plan.x = {"run", "run, its six towels side by side"};
  plan.y = {"dry_s", "time until dry [s]"};
  plan.parameter = "rate_kg_m2_s";
  plan.start = 2e-4;
  for (const std::string& run : table.distinct("run")) plan.groups.push_back(towelsOf(table.where("run", run)));
  return plan;
}

}  // namespace reality
