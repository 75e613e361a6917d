// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/Image.h"

#include <string>

namespace pictures {

/// Writes a picture as PNG. Throws std::runtime_error that says why when it cannot.
void writePng(const std::string& path, const Image& image);

}  // namespace pictures
