#pragma once

#include "JsonCursor.h"
#include "Scene.h"

namespace runner {

/// Reads a cloth's "effects": only the named ones are set. `nodes` is the cloth's number of nodes.
void readEffects(JsonCursor cursor, int nodes, ClothScene& cloth);

}  // namespace runner
