// SPDX-License-Identifier: Zlib
#include "command/scene/DryScene.h"

#include <algorithm>

namespace command {
namespace {

bool isOfWater(const EffectScene& effect) { return effect.water != WaterRole::none; }

}  // namespace

Scene dryScene(const Scene& scene) {
  Scene dry = scene;
  for (ClothScene& cloth : dry.cloths) {
    cloth.initialSaturation = 0;
    cloth.effects.erase(std::remove_if(cloth.effects.begin(), cloth.effects.end(), isOfWater), cloth.effects.end());
  }
  return dry;
}

}  // namespace command
