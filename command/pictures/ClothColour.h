// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <array>
#include <cstdint>

namespace pictures {

/// Colour of a cloth where its saturation is this, linear RGB.
Rgb clothColour(const ClothShape& cloth, float saturation);

/// Eight bits a channel, as screens and images want it (sRGB, IEC 61966-2-1).
std::array<std::uint8_t, 3> encodedColour(const Rgb& linear);

}  // namespace pictures
