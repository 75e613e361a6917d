// SPDX-License-Identifier: Zlib
#include "command/reality/Studies.h"

#include "command/accuracy/Specimen.h"

namespace reality {
namespace {

constexpr double soakedFor = 10;    // [s]
constexpr double soakStep = 0.1;    // [s]
constexpr double soakDoubt = 0.05;  // [kg/kg]

/// Water over dry mass of cotton after ten seconds in water.
double soak(double timeConstant) {
  accuracy::Specimen::Settings settings;
  settings.patch = accuracy::levelSquare(0.1, 2);
  settings.patch.pinnedEdges = {wetcloth::ClothPatch::Edge::bottom, wetcloth::ClothPatch::Edge::top};
  settings.fabric.timeConstant = timeConstant;
  accuracy::Specimen sample(settings);
  sample.cloth().add<wetcloth::Absorption>();
  for (int i = 0; i < static_cast<int>(soakedFor / soakStep + 0.5); ++i) sample.substep(soakStep);
  return sample.cloth().saturation(0) * settings.fabric.capacity;
}

}  // namespace

Plan planAbsorption(const std::string& file) {
  const command::MeasuredTable table(file);
  Plan plan;
  plan.name = "absorption";
  plan.title = "Water that towels take up in ten seconds";
  plan.model = "Absorption of Fabric::cotton() for 10 s, its capacity of 0.84 kg/kg";
  plan.halves = "the first, third, fifth ... towel is fitted, the others are predicted";
  plan.doubt = "not stated, one sample each; 0.05 kg/kg is assumed";
  plan.x = {"towel", "towel"};
  plan.y = {"uptake_kg_kg", "water over dry mass [kg/kg]"};
  plan.parameter = "time_constant_s";
  plan.start = wetcloth::Fabric::cotton().timeConstant;
  const std::vector<double> uptake = table.numbers("uptake_kg_kg", command::MeasuredTable::Allowed::positive);
  table.requireRows(4, "to fit one half and predict the other");
  Sample towels;
  towels.name = "cotton and blends";
  for (std::size_t i = 0; i < uptake.size(); ++i) {
    towels.at.push_back(static_cast<double>(i + 1));
    towels.measured.push_back(uptake[i]);
    towels.uncertainty.push_back(soakDoubt);
    towels.isFitted.push_back(i % 2 == 0);
  }
  towels.run = [count = uptake.size()](double timeConstant) { return std::vector<double>(count, soak(timeConstant)); };
  plan.groups = {{towels}};
  return plan;
}

}  // namespace reality
