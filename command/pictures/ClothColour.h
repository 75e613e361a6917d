// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pictures {

/// Colours of a cloth's nodes, linear RGB; on a seam that of the part that comes first.
/// @param saturation  one per node
std::vector<Rgb> clothColours(const ClothShape& cloth, const std::vector<float>& saturation);

/// Eight bits a channel, as screens and images want it (sRGB, IEC 61966-2-1).
std::array<std::uint8_t, 3> encodedColour(const Rgb& linear);

}  // namespace pictures
