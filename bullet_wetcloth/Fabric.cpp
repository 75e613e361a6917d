// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/Fabric.h"

#include "bullet_wetcloth/Require.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

Fabric preset(const char* name, double capacity, double timeConstant, double arealDensity,
              const std::array<double, 3>& dryColour) {
  Fabric fabric;
  fabric.name = name;
  fabric.capacity = capacity;
  fabric.timeConstant = timeConstant;
  fabric.arealDensity = arealDensity;
  fabric.dryColour = dryColour;
  return fabric;
}

}  // namespace

Fabric Fabric::cotton() { return preset("cotton", 0.84, 8.844, 0.150, {0.72, 0.62, 0.45}); }

Fabric Fabric::coarseWool() { return preset("coarse_wool", 1.24, 4.8936, 0.300, {0.50, 0.42, 0.34}); }

Fabric Fabric::highAbsorption() { return preset("high_absorption", 2.492, 3.3803, 0.400, {0.35, 0.55, 0.65}); }

Fabric Fabric::tableII() { return preset("table_ii", 83, 8.844, 0.010, {0.70, 0.30, 0.25}); }

const std::vector<Fabric>& Fabric::presets() {
  static const std::vector<Fabric> all = {cotton(), coarseWool(), highAbsorption(), tableII()};
  return all;
}

Fabric Fabric::byName(const std::string& name) {
  std::string known;
  for (const Fabric& fabric : presets()) {
    if (fabric.name == name) return fabric;
    known += (known.empty() ? "" : ", ") + fabric.name;
  }
  rejectValue("fabric", '"' + name + '"', "one of " + known);
}

void requireValid(const Fabric& fabric, const std::string& name) {
  requirePositive(name + ".capacity", fabric.capacity);
  requirePositive(name + ".timeConstant", fabric.timeConstant);
  requirePositive(name + ".arealDensity", fabric.arealDensity);
  for (const double channel : fabric.dryColour) requireFraction(name + ".dryColour", channel);
  requireFraction(name + ".dryRoughness", fabric.dryRoughness);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
