// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <string>

namespace pictures {

/// Writes the run as one USD file in text form (.usda): a Mesh for each cloth with time-sampled points [m], normals,
/// primvars:displayColor (linear RGB) and primvars:wetness (water over capacity, [0, 1]), all by vertex, and
/// primvars:st; a Mesh for each thing that stands around. A time code is a frame. upAxis is Y or Z, whichever is nearer
/// to up. Throws std::runtime_error when the file could not be written.
void writeUsd(const FrameSequence& sequence, const std::string& path);

}  // namespace pictures
