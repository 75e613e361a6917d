// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <string>

namespace pictures {

/// Writes into a folder for each cloth CLOTH.obj, its mesh at the first frame with its own texture coordinates, or some
/// in [0, 1] where it has none, and CLOTH.pc2, its vertices at every frame; and scenery.obj with what stands around, if
/// anything does.
/// Throws std::runtime_error that says why a file could not be written.
void writeObjAndPointCaches(const FrameSequence& sequence, const std::string& folder);

}  // namespace pictures
