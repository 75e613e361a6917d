// SPDX-License-Identifier: Zlib
#include "command/reality/DryingCloth.h"
#include "command/reality/Studies.h"

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

/// Those that the rate is fitted to; the others are predicted.
bool isOfFirstThree(const std::string& towel) {
  return towel == "decathlon" || towel == "hema" || towel == "care_plus";
}

std::vector<Sample> towelsOf(const command::MeasuredTable& run) {
  using Allowed = command::MeasuredTable::Allowed;
  const std::vector<std::string> names = run.words("towel");
  const std::vector<double> number = run.numbers("run", Allowed::positive);
  const std::vector<double> water = run.numbers("water_kg", Allowed::positive);
  const std::vector<double> area = run.numbers("area_m2", Allowed::positive);
  const std::vector<double> measured = run.numbers("dry_s", Allowed::positive);
  std::vector<Sample> towels;
  for (std::size_t i = 0; i < names.size(); ++i) {
    Sample towel;
    towel.name = "run " + run.words("run")[i] + " " + names[i];
    towel.at = {number[i] + sideBySide * static_cast<double>(i)};
    towel.measured = {measured[i]};
    towel.uncertainty = {doubtOf(names[i])};
    towel.isFitted = {isOfFirstThree(names[i])};
    towel.run = [water = water[i], area = area[i]](double rate) {
      return std::vector<double>{timeToDry(water, area, rate)};
    };
    towels.push_back(towel);
  }
  return towels;
}

}  // namespace

Plan planTowels(const std::string& file) {
  const command::MeasuredTable table(file);
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
  std::vector<std::string> runs = table.words("run");
  runs.erase(std::unique(runs.begin(), runs.end()), runs.end());
  for (const std::string& run : runs) plan.groups.push_back(towelsOf(table.where("run", run)));
  return plan;
}

}  // namespace reality
