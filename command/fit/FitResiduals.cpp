// SPDX-License-Identifier: Zlib
#include "command/fit/FitResiduals.h"

#include <cmath>
#include <cstddef>

namespace fit {

std::vector<double> residualsOf(const Task& task, const Fit& fit) {
  std::vector<double> residuals;
  for (std::size_t i = 0; i < fit.model.size(); ++i) residuals.push_back(task.readings.values[i] - fit.model[i]);
  return residuals;
}

double rootMeanSquare(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double number : numbers) sum += number * number;
  return std::sqrt(sum / static_cast<double>(numbers.size()));
}

double standardDeviation(const std::vector<double>& numbers) {
  double mean = 0;
  for (const double number : numbers) mean += number / static_cast<double>(numbers.size());
  std::vector<double> away;
  for (const double number : numbers) away.push_back(number - mean);
  return rootMeanSquare(away);
}

}  // namespace fit
