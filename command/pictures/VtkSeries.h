// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <string>

namespace pictures {

/// Writes each cloth at each frame into a folder as VTK PolyData, CLOTH_0000.vtp and so on (XML, binary appended), and
/// run.pvd, which lists them with their times [s] for ParaView. Per point: wetness (water over capacity, [0, 1]),
/// speed [m/s], stretch (largest of its links' length over length at rest), colour (sRGB, 8 bit), Normals.
/// Throws std::runtime_error that says why a file could not be written.
void writeVtkSeries(const FrameSequence& sequence, const std::string& folder);

}  // namespace pictures
