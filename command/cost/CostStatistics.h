// SPDX-License-Identifier: Zlib
#pragma once

#include <vector>

namespace command {

/// A typical value of samples whose errors are outliers: another process that took the core for a while.
struct CostEstimate {
  double median = 0;
  double halfWidth = 0;  ///< of an interval of 95 % about the median, whatever the samples' distribution
  double mean = 0;       ///< also of what is done in a few steps only
  double meanHalfWidth = 0;
};

CostEstimate estimate(std::vector<double> samples);

/// What turned each `before` into its `after`, sample by sample.
CostEstimate estimateDifference(const std::vector<double>& after, const std::vector<double>& before);
CostEstimate estimateRatio(const std::vector<double>& after, const std::vector<double>& before);

}  // namespace command
