#pragma once

#include "JsonCursor.h"
#include "Scene.h"

namespace runner {

// One for each effect: reads its object in a scene. `nodes` is the cloth's number of nodes.
AddEffect readAbsorption(JsonCursor cursor, int nodes);
AddEffect readWind(JsonCursor cursor, int nodes);
AddEffect readHookeSprings(JsonCursor cursor, int nodes);
AddEffect readCollisionAudit(JsonCursor cursor, int nodes);

}  // namespace runner
