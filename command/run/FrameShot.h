// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/SceneWorld.h"

#include <vector>

namespace command {

/// What a picture needs to know of one moment of a run.
struct FrameShot {
  struct Cloth {
    std::vector<btVector3> positions;
    std::vector<wetcloth::Colour> colours;  ///< linear RGB
    std::vector<double> roughnesses;
  };

  double time = 0;            ///< [s]
  double meanSaturation = 0;  ///< water over capacity, all cloths together
  std::vector<Cloth> cloths;
};

FrameShot takeShot(const SceneWorld& world, double time);

}  // namespace command
