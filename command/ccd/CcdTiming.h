// SPDX-License-Identifier: Zlib
#pragma once

#include "command/ccd/CcdMethod.h"

namespace command {

/// Nanoseconds per query.
struct CcdTimes {
  double mean = 0;  ///< of all queries in one go
  /// Of each query by itself, or each batch, less what reading the clock costs. Nothing overlaps with its neighbours
  /// here, so a short query may be longer than the mean.
  double median = 0;
  double p99 = 0;
  double worst = 0;
};

/// Times a method that has at least one query. Everything is done `passes` times, and the median of them counts.
CcdTimes timeOf(const CcdMethod& method, int passes);

}  // namespace command
