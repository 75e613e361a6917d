// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/EffectReader.h"

namespace command {

// One for each effect: reads its object in a scene.
AddEffect readAbsorption(JsonCursor cursor, const EffectContext& context);
AddEffect readImmersion(JsonCursor cursor, const EffectContext& context);
AddEffect readRain(JsonCursor cursor, const EffectContext& context);
AddEffect readSplash(JsonCursor cursor, const EffectContext& context);
AddEffect readContactWetting(JsonCursor cursor, const EffectContext& context);
AddEffect readDiffusion(JsonCursor cursor, const EffectContext& context);
AddEffect readSeepage(JsonCursor cursor, const EffectContext& context);
AddEffect readDripping(JsonCursor cursor, const EffectContext& context);
AddEffect readDrying(JsonCursor cursor, const EffectContext& context);
AddEffect readWetStiffness(JsonCursor cursor, const EffectContext& context);
AddEffect readSwelling(JsonCursor cursor, const EffectContext& context);
AddEffect readWind(JsonCursor cursor, const EffectContext& context);
AddEffect readWaterDrag(JsonCursor cursor, const EffectContext& context);
AddEffect readCling(JsonCursor cursor, const EffectContext& context);
AddEffect readHookeSprings(JsonCursor cursor, const EffectContext& context);
AddEffect readWetFriction(JsonCursor cursor, const EffectContext& context);
AddEffect readCollisionAudit(JsonCursor cursor, const EffectContext& context);

}  // namespace command
