// SPDX-License-Identifier: Zlib
#include "command/scene/LeaveOut.h"

#include <algorithm>

namespace command {

Scene leaveOut(const Scene& scene, const std::function<bool(const EffectScene&)>& isUnwanted) {
  Scene rest = scene;
  for (ClothScene& cloth : rest.cloths) {
    cloth.effects.erase(std::remove_if(cloth.effects.begin(), cloth.effects.end(), isUnwanted), cloth.effects.end());
  }
  return rest;
}

}  // namespace command
