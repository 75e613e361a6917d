// SPDX-License-Identifier: Zlib
#include "command/reality/Studies.h"

#include "command/accuracy/Specimen.h"

#include <cmath>

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
  for (int i = 0; i < std::lround(soakedFor / soakStep); ++i) sample.substep(soakStep);
  return sample.cloth().saturation(0) * settings.fabric.capacity;
}

}  // namespace

Plan planAbsorption(const std::string& file) {
  using Allowed = command::MeasuredTable::Allowed;
  const command::MeasuredTable table = command::MeasuredTable(file).sortedBy("towel");
  table.requireRows(4, "to fit one half and predict the other");
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
  Sample towels;
  towels.name = "cotton and blends";
  towels.at = table.increasing("towel", Allowed::positive);
  towels.measured = table.numbers("uptake_kg_kg", Allowed::positive);
  towels.uncertainty.assign(table.rows(), soakDoubt);
  for (const double towel : towels.at) towels.isFitted.push_back(std::fmod(towel, 2) == 1);
  towels.run = [count = table.rows()](double timeConstant) { return std::vector<double>(count, soak(timeConstant)); };
  plan.groups = {{towels}};
  return plan;
}

}  // namespace reality
