// SPDX-License-Identifier: Zlib
#include "command/scene/EffectReader.h"

#include "command/scene/EffectReaders.h"

namespace command {
namespace {

struct EffectKey {
  const char* key;
  AddEffect (*read)(JsonCursor cursor, const EffectContext& context);
};

/// In the order in which they are added; springs before what changes them.
const EffectKey effectKeys[] = {{"hooke_springs", readHookeSprings},
                                {"absorption", readAbsorption},
                                {"immersion", readImmersion},
                                {"rain", readRain},
                                {"splash", readSplash},
                                {"contact_wetting", readContactWetting},
                                {"diffusion", readDiffusion},
                                {"seepage", readSeepage},
                                {"dripping", readDripping},
                                {"drying", readDrying},
                                {"wet_stiffness", readWetStiffness},
                                {"swelling", readSwelling},
                                {"wind", readWind},
                                {"water_drag", readWaterDrag},
                                {"cling", readCling},
                                {"wet_friction", readWetFriction},
                                {"collision_audit", readCollisionAudit}};

}  // namespace

std::vector<EffectScene> readEffects(JsonCursor cursor, const EffectContext& context) {
  cursor.expectObject(keys::effects);
  std::vector<EffectScene> effects;
  for (const EffectKey& effect : effectKeys) {
    if (const auto found = cursor.find(effect.key)) effects.push_back({effect.key, effect.read(*found, context)});
  }
  return effects;
}

}  // namespace command
