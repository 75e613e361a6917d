// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

namespace pictures {

/// Viridis (S. van der Walt, N. Smith), whose steps look equal: from dark blue at 0 to yellow at 1. sRGB.
Rgb mappedColour(float value);

}  // namespace pictures
