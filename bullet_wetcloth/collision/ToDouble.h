// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/IeeeArithmetic.h"
#include "bullet_wetcloth/collision/Query.h"

#include <cstdint>
#include <cstring>

namespace wetcloth::collision {

/// A float as a double, exactly. From its bits where it is denormal, because a processor that takes denormals for 0
/// does so in a conversion, too.
inline double toDouble(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  if ((bits & 0x7f800000U) != 0) return double(value);
  const double size = double(bits & 0x7fffffU) * 0x1p-149;
  return (bits >> 31U) != 0 ? -size : size;
}

inline Query<double> toDouble(const Query<float>& query) {
  Query<double> result;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) {
      result.start[i][k] = toDouble(query.start[i][k]);
      result.end[i][k] = toDouble(query.end[i][k]);
    }
  }
  return result;
}

inline const Query<double>& toDouble(const Query<double>& query) { return query; }

}  // namespace wetcloth::collision
