// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/JsonCursor.h"
#include "command/scene/Scene.h"

namespace command {

/// An element of a scene's "figures": adds its parts to the scene's colliders, each moved by its joint.
void readFigure(JsonCursor cursor, Scene& scene);

}  // namespace command
