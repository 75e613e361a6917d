// SPDX-License-Identifier: Zlib
#include "command/pictures/Image.h"

#include <cstddef>

namespace pictures {

Image::Image(int wide, int high)
    : width(wide), height(high), rgb(3 * static_cast<std::size_t>(wide) * static_cast<std::size_t>(high)) {}

}  // namespace pictures
