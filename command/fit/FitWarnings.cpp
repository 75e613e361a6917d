// SPDX-License-Identifier: Zlib
#include "command/fit/FitWarnings.h"

#include "command/fit/FitResiduals.h"

#include <algorithm>
#include <cstdio>

namespace fit {
namespace {

/// A law that leaves half of what a constant would leave says little about these readings.
bool isPoor(const Task& task, const Fit& fit) {
  return !(rootMeanSquare(residualsOf(task, fit)) < 0.5 * standardDeviation(task.readings.values));
}

/// Says so where the number is not in its range; empty where it is. @param verb  "reaches" or "is"
std::string doubtOf(const ClothRange& range, const char* verb, double number) {
  if (number >= range.least && number <= range.most) return "";
  char numbers[120];
  std::snprintf(numbers, sizeof numbers, " %s %.4g, of cloth it is %.4g to %.4g: ", verb, number, range.least,
                range.most);
  return range.name + numbers + range.because + "; are the units right?";
}

/// The first value that cloth cannot have: one wrong unit makes all of them wrong.
std::vector<std::string> doubtOfValues(const Task& task, const Fit& fit) {
  for (const ClothRange& range : task.ranges) {
    for (std::size_t i = 0; i < task.unknowns.size(); ++i) {
      if (range.name != task.unknowns[i].name) continue;
      const std::string doubt = doubtOf(range, "is", fit.estimates[i].value);
      if (!doubt.empty()) return {doubt};
    }
  }
  return {};
}

}  // namespace

std::vector<std::string> doubtsOf(const Task& task) {
  std::vector<std::string> doubts;
  for (const ClothRange& range : task.ranges) {
    const bool isX = range.name == task.x.column;
    if (!isX && range.name != task.y.column) continue;
    const std::vector<double>& column = isX ? task.at : task.readings.values;
    const std::string doubt = doubtOf(range, "reaches", *std::max_element(column.begin(), column.end()));
    if (!doubt.empty()) doubts.push_back(doubt);
  }
  return doubts;
}

std::vector<std::string> warningsOf(const Task& task, const Fit& fit) {
  std::vector<std::string> warnings;
  if (!fit.hasConverged) warnings.emplace_back("the search did not converge: other values may fit better");
  std::vector<std::string> doubts = doubtsOf(task);
  if (doubts.empty() && isPoor(task, fit)) {
    warnings.push_back("this law does not describe these readings; are columns and units right (" + task.x.column +
                       ", " + task.y.column + ")?");
  }
  if (doubts.empty()) doubts = doubtOfValues(task, fit);
  warnings.insert(warnings.end(), doubts.begin(), doubts.end());
  return warnings;
}

}  // namespace fit
