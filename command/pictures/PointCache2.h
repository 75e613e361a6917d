// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <cstddef>
#include <string>

namespace pictures {

/// Writes where a cloth's vertices are at every frame as PC2, which Blender's modifier Mesh Cache plays: a header of
/// 32 bytes, then x, y, z [m] of each vertex in float32, frame by frame. The first frame's number is 0, and each
/// frame of the run is one of the program that reads it.
/// Throws std::runtime_error that says why it could not be written.
void writePointCache(const FrameSequence& sequence, std::size_t cloth, const std::string& path);

}  // namespace pictures
