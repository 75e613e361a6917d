// SPDX-License-Identifier: Zlib
#include "command/scene/DryScene.h"

#include "command/scene/LeaveOut.h"

namespace command {

Scene dryScene(const Scene& scene) {
  Scene dry = leaveOut(scene, [](const EffectScene& effect) { return effect.water != WaterRole::none; });
  for (ClothScene& cloth : dry.cloths) cloth.makeDry();
  dry.drops.reset();
  return dry;
}

}  // namespace command
