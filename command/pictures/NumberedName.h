// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <string>

namespace pictures {

/// "towel_0042.ply". Four digits, more when there are more frames than those can count.
inline std::string numberedName(const std::string& name, std::size_t number, const std::string& suffix) {
  const std::string digits = std::to_string(number);
  return name + "_" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits + suffix;
}

}  // namespace pictures
