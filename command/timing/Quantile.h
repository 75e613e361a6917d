// SPDX-License-Identifier: Zlib
#pragma once

#include <vector>

namespace command {

/// The value that this fraction of the values does not exceed: the one of the nearest rank.
/// @param values  at least one; @param fraction  [0, 1]
double quantile(std::vector<double> values, double fraction);

/// The middle one, of an even number the upper of the two. @param values  at least one
double median(std::vector<double> values);

}  // namespace command
