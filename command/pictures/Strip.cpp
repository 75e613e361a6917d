// SPDX-License-Identifier: Zlib
#include "command/pictures/Strip.h"

#include <algorithm>
#include <cstddef>

namespace pictures {

Image strip(const std::vector<Image>& images) {
  const Image& first = images.front();
  Image whole(first.width * static_cast<int>(images.size()), first.height);
  const std::size_t row = 3 * static_cast<std::size_t>(first.width);
  std::uint8_t* to = whole.rgb.data();
  for (std::size_t y = 0; y < static_cast<std::size_t>(first.height); ++y) {
    for (const Image& image : images) to = std::copy_n(image.rgb.data() + y * row, row, to);
  }
  return whole;
}

}  // namespace pictures
