// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <vector>

namespace pictures {

/// A ball around all that is to be seen but the ground and the sky.
struct Extent {
  Vector3 middle{};
  float radius = 1;  ///< [m]
};

Extent extentOf(const std::vector<Vector3>& points);

/// Of the cloths and solids.
std::vector<Vector3> pointsOf(const Scenery& scenery, const Frame& frame);

}  // namespace pictures
