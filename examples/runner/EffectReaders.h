#pragma once

#include "JsonCursor.h"
#include "Scene.h"

namespace runner {

// One for each effect: reads its object in a scene. `nodes` is the cloth's number of nodes.
AddEffect readAbsorption(JsonCursor cursor, int nodes);
AddEffect readImmersion(JsonCursor cursor, int nodes);
AddEffect readRain(JsonCursor cursor, int nodes);
AddEffect readSplash(JsonCursor cursor, int nodes);
AddEffect readContactWetting(JsonCursor cursor, int nodes);
AddEffect readDiffusion(JsonCursor cursor, int nodes);
AddEffect readSeepage(JsonCursor cursor, int nodes);
AddEffect readDripping(JsonCursor cursor, int nodes);
AddEffect readDrying(JsonCursor cursor, int nodes);
AddEffect readWetStiffness(JsonCursor cursor, int nodes);
AddEffect readSwelling(JsonCursor cursor, int nodes);
AddEffect readWind(JsonCursor cursor, int nodes);
AddEffect readWaterDrag(JsonCursor cursor, int nodes);
AddEffect readCling(JsonCursor cursor, int nodes);
AddEffect readHookeSprings(JsonCursor cursor, int nodes);
AddEffect readWetFriction(JsonCursor cursor, int nodes);
AddEffect readCollisionAudit(JsonCursor cursor, int nodes);

}  // namespace runner
