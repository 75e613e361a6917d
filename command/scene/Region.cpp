// SPDX-License-Identifier: Zlib
#include "command/scene/Region.h"

namespace command {

bool Region::holds(const btVector3& place) const {
  if (const auto* box = std::get_if<Box>(&shape)) {
    const btVector3 inside = box->halfExtents - (place - box->centre).absolute();
    return inside[inside.minAxis()] >= 0;
  }
  const auto& sphere = std::get<Sphere>(shape);
  return static_cast<double>((place - sphere.centre).length()) <= sphere.radius;
}

}  // namespace command
