// SPDX-License-Identifier: Zlib
#include "command/reality/DryingCloth.h"
#include "command/reality/Studies.h"

namespace reality {
namespace {

constexpr double shirtDensity = 0.150;  // of both [kg/m^2]: poplin and jersey
constexpr double balanceDoubt = 0.001;  // [kg]
constexpr double shirtStep = 5;         // [s]

struct Shirt {
  wetcloth::Fabric fabric;
  double dryMass;  ///< in room air [kg]
};

/// Mass of a shirt at these times [kg].
std::vector<double> dryShirt(const Shirt& shirt, double firstMass, double rate, const std::vector<double>& times) {
  DryingCloth::Settings settings;
  settings.fabric = shirt.fabric;
  settings.area = shirt.dryMass / shirt.fabric.arealDensity;
  settings.water = firstMass - shirt.dryMass;
  settings.rate = rate;
  settings.criticalSaturation = wetcloth::Drying::Parameters{}.criticalSaturation;
  DryingCloth cloth(settings);
  std::vector<double> masses;
  for (const double time : times) {
    while (cloth.time() < time - shirtStep / 2) cloth.advance(shirtStep);
    masses.push_back(shirt.dryMass + cloth.water());
  }
  return masses;
}

Sample sampleOf(const command::MeasuredTable& table, const std::string& name, Shirt shirt) {
  shirt.fabric.arealDensity = shirtDensity;
  Sample sample;
  sample.name = name;
  sample.at = table.increasing("time_s");
  sample.measured = table.numbers(name + "_shirt_kg", command::MeasuredTable::Allowed::positive);
  sample.uncertainty.assign(sample.at.size(), balanceDoubt);
  sample.run = [shirt, times = sample.at, first = sample.measured.front()](double rate) {
    return dryShirt(shirt, first, rate, times);
  };
  return sample;
}

/// Merino and cotton, with which of their readings are fitted still to be said.
std::vector<Sample> shirtsOf(const std::string& file) {
  const command::MeasuredTable table = command::MeasuredTable(file).sortedBy("time_s");
  table.requireRows(4, "to fit one half and predict the other");
  return {sampleOf(table, "merino", {wetcloth::Fabric::coarseWool(), 0.135}),
          sampleOf(table, "cotton", {wetcloth::Fabric::cotton(), 0.162})};
}

Plan planOfShirts() {
  Plan plan;
  plan.model = "Drying with its critical saturation of 0.3, of Fabric::coarseWool() and cotton(), both of 150 g/m2";
  plan.doubt = "1 g, the balance's resolution";
  plan.x = {"time_s", "time [s]"};
  plan.y = {"mass_kg", "mass of the shirt [kg]"};
  plan.isOverTime = true;
  plan.parameter = "rate_kg_m2_s";
  plan.start = 3.6e-5;
  return plan;
}

}  // namespace

Plan planShirts(const std::string& file) {
  Plan plan = planOfShirts();
  plan.name = "shirts";
  plan.title = "Mass of two shirts that dry on a line outdoors";
  plan.halves = "of each shirt the earlier half of the readings is fitted, the later half predicted";
  for (Sample& shirt : shirtsOf(file)) {
    for (std::size_t i = 0; i < shirt.at.size(); ++i) shirt.isFitted.push_back(i < shirt.at.size() / 2);
    plan.groups.push_back({shirt});
  }
  return plan;
}

Plan planOtherShirt(const std::string& file) {
  Plan plan = planOfShirts();
  plan.name = "other_shirt";
  plan.title = "A cotton shirt dries, by the rate of a woollen one";
  plan.halves = "merino is fitted, cotton predicted, as if air reached both alike";
  std::vector<Sample> shirts = shirtsOf(file);
  for (Sample& shirt : shirts) shirt.isFitted.assign(shirt.at.size(), shirt.name == "merino");
  plan.groups = {shirts};
  return plan;
}

}  // namespace reality
