// SPDX-License-Identifier: Zlib
#include "command/stability/StabilityTable.h"

#include "command/stability/Cases.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace stability {

const std::vector<HardCase>& stabilityTable() {
  static const std::vector<HardCase> table = [] {
    std::vector<HardCase> all;
    for (auto* const group : {massCases, windCases, meshCases, contactCases, timeCases, springCases, cubicCases,
                              guardCases, wornCases, laundryCases, dropCases}) {
      for (HardCase& hardCase : group()) all.push_back(std::move(hardCase));
    }
    return all;
  }();
  return table;
}

std::vector<std::string> caseNames() {
  std::vector<std::string> names;
  for (const HardCase& hardCase : stabilityTable()) names.push_back(hardCase.name);
  return names;
}

std::vector<std::string> groupNames() {
  std::vector<std::string> names;
  for (const HardCase& hardCase : stabilityTable()) {
    if (std::find(names.begin(), names.end(), hardCase.group) == names.end()) names.push_back(hardCase.group);
  }
  return names;
}

const std::vector<double>& stabilitySteps() {
  static const std::vector<double> steps{1. / 1000, 1. / 240, 1. / 60, 1. / 30, 1. / 10};
  return steps;
}

const std::vector<double>& quickSteps() {
  static const std::vector<double> steps{1. / 240, 1. / 30};
  return steps;
}

std::string stepName(double step) {
  if (step == 0) return "-";
  const double inverse = 1 / step;
  const double rounded = std::round(inverse);
  char text[32];
  if (rounded >= 2 && std::fabs(inverse - rounded) < 1e-6 * inverse) {
    std::snprintf(text, sizeof text, "1/%.0f", rounded);
  } else {
    std::snprintf(text, sizeof text, "%g", step);
  }
  return text;
}

}  // namespace stability
