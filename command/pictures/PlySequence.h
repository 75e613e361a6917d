// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <string>

namespace pictures {

/// Writes each cloth at each frame into a folder: CLOTH_0000.ply and so on. Stanford PLY, binary little endian; per
/// vertex x, y, z [m], nx, ny, nz, red, green, blue (sRGB, 8 bit), wetness (water over capacity, [0, 1]).
/// Throws std::runtime_error that says why a file could not be written.
void writePlySequence(const FrameSequence& sequence, const std::string& folder);

}  // namespace pictures
