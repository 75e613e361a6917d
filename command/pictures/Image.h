// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pictures {

/// Eight bits each of red, green and blue (sRGB), from the top left, row by row.
struct Image {
  int width = 0;   ///< [pixels]
  int height = 0;  ///< [pixels]
  std::vector<std::uint8_t> rgb;

  Image() = default;
  Image(int wide, int high);
};

}  // namespace pictures
