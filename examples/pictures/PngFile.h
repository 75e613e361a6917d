#pragma once

#include "Image.h"

#include <string>

namespace pictures {

/// Writes a picture as PNG. Throws std::runtime_error when it cannot; then there is no file of the name, or the one
/// that was there before.
void writePng(const std::string& file, const Image& image);

}  // namespace pictures
