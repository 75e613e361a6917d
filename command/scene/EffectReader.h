// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/JsonCursor.h"
#include "command/scene/Scene.h"

#include <vector>

namespace command {

/// What the objects of a cloth's effects may refer to; read before them.
struct EffectContext {
  const Scene& scene;       ///< its water and colliders
  const ClothScene& cloth;  ///< its shape
};

/// Reads a cloth's "effects": only the named ones are there, in the order in which they are to be added.
std::vector<EffectScene> readEffects(JsonCursor cursor, const EffectContext& context);

}  // namespace command
