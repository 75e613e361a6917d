// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/Image.h"

#include <vector>

namespace pictures {

/// Pictures of one size side by side.
Image strip(const std::vector<Image>& images);

}  // namespace pictures
