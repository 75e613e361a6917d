// SPDX-License-Identifier: Zlib
#include "command/timing/Quantile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace command {

double quantile(std::vector<double> values, double fraction) {
  const auto rank = std::lround(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

}  // namespace command
