// SPDX-License-Identifier: Zlib
#include "command/scene/DryScene.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace command {
namespace {

constexpr std::array<std::string_view, 9> waterEffects{
    "absorption", "immersion", "rain", "splash", "contact_wetting", "diffusion", "seepage", "dripping", "drying"};

bool isOfWater(const EffectScene& effect) {
  return std::find(waterEffects.begin(), waterEffects.end(), effect.key) != waterEffects.end();
}

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
