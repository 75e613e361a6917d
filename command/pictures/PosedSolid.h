// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <cstddef>
#include <vector>

namespace pictures {

/// A solid of the scenery as it is in a frame.
Solid posedSolid(const Scenery& scenery, const Frame& frame, std::size_t solid);
/// The vertices of all solids as they are in a frame [m].
std::vector<Vector3> posedVertices(const Scenery& scenery, const Frame& frame);

}  // namespace pictures
