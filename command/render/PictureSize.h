// SPDX-License-Identifier: Zlib
#pragma once

#include <string>

namespace command {

struct PictureSize {
  int width = 0;   ///< [pixels]
  int height = 0;  ///< [pixels]
};

/// Reads "1280x720". Throws InputError naming --size when it is not two numbers from 16 to 8192, or when both have to
/// be even and are not.
PictureSize readSize(const std::string& text, bool evenOnly);

}  // namespace command
