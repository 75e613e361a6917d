// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/bullet_wetcloth.h"

#include <LinearMath/btTransform.h>

#include <cstddef>
#include <vector>

namespace command {

/// What a scene asks of drops that fly and land.
struct DropsScene {
  /// A collider that is a cylinder, full of water up to its rim or less: it gives as it tips.
  struct FullGlass {
    wetcloth::Glass glass;  ///< without a pose
    std::size_t collider = 0;
    btTransform rest = btTransform::getIdentity();  ///< of the glass, while the collider is at rest
  };

  wetcloth::Drops::Parameters parameters;
  std::vector<wetcloth::Pour> pours;
  std::vector<FullGlass> glasses;
};

}  // namespace command
