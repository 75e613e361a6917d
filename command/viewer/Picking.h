// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <LinearMath/btVector3.h>

#include <optional>
#include <vector>

namespace viewer {

struct Ray {
  btVector3 origin;     ///< [m]
  btVector3 direction;  ///< of length 1
};

/// Where a ray meets a cloth.
struct Hit {
  int cloth = 0;
  int node = 0;         ///< the nearest corner of the triangle
  btScalar distance{};  ///< along the ray [m]
};

/// The first cloth on the ray, unless something that cloth lies on, or hangs over, is before it.
std::optional<Hit> pickCloth(const Ray& ray, const pictures::Scenery& scenery,
                             const std::vector<pictures::ClothShape>& cloths, const pictures::Frame& frame);

}  // namespace viewer
