// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/SceneWorld.h"

namespace command {

/// The saturation of all nodes of a scene.
struct Saturation {
  double min = 0;
  double mean = 0;  ///< all water over all that could be held
  double max = 0;
};

Saturation saturationOf(const SceneWorld& world);

}  // namespace command
