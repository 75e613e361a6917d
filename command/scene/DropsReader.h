// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/DropsScene.h"
#include "command/scene/JsonCursor.h"
#include "command/scene/Scene.h"

namespace command {

/// A scene's "drops", after its colliders and its water were read.
DropsScene readDrops(JsonCursor cursor, const Scene& scene);

}  // namespace command
