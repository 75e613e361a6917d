#pragma once

#include "JsonCursor.h"
#include "Scene.h"

#include <vector>

namespace runner {

/// Reads a cloth's "effects": only the named ones are there, in the order in which they are to be added. `nodes` is the
/// cloth's number of nodes.
std::vector<EffectScene> readEffects(JsonCursor cursor, int nodes);

}  // namespace runner
