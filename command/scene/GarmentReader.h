// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Garment.h"
#include "command/scene/JsonCursor.h"
#include "command/scene/Scene.h"

namespace command {

/// Reads "garment" of a cloth into its shape and what is special about it. @param cloth  with its fabric
void readGarment(JsonCursor cursor, ClothScene& cloth);

}  // namespace command
