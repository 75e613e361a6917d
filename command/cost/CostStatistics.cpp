// SPDX-License-Identifier: Zlib
#include "command/cost/CostStatistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace command {
namespace {

template <class Operation>
CostEstimate estimatePairs(const std::vector<double>& after, const std::vector<double>& before, Operation operation) {
  std::vector<double> samples(after.size());
  std::transform(after.begin(), after.end(), before.begin(), samples.begin(), operation);
  return estimate(std::move(samples));
}

}  // namespace

CostEstimate estimate(std::vector<double> samples) {
  if (samples.empty()) return {};
  std::sort(samples.begin(), samples.end());
  const auto count = static_cast<double>(samples.size());
  const std::size_t last = samples.size() - 1;
  const std::size_t middle = samples.size() / 2;
  // How many of n samples lie below the true median is binomial, n / 2 +- sqrt(n) / 2.
  const auto reach = static_cast<std::size_t>(std::ceil(0.98 * std::sqrt(count)));
  const double median = samples[middle];
  const double low = samples[middle > reach ? middle - reach : 0];
  const double high = samples[std::min(last, middle + reach)];
  const double mean = std::accumulate(samples.begin(), samples.end(), 0.0) / count;
  double squares = 0;
  for (const double sample : samples) squares += (sample - mean) * (sample - mean);
  return {median, std::max(median - low, high - median), mean, 1.96 * std::sqrt(squares) / count};
}

CostEstimate estimateDifference(const std::vector<double>& after, const std::vector<double>& before) {
  return estimatePairs(after, before, [](double a, double b) { return a - b; });
}

CostEstimate estimateRatio(const std::vector<double>& after, const std::vector<double>& before) {
  return estimatePairs(after, before, [](double a, double b) { return a / b; });
}

}  // namespace command
