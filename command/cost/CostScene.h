// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

namespace command {

/// What `wetcloth cost` measures when it is given no scene: a cloth of 64 x 64 nodes that hangs from two corners, wet
/// enough to drip and dry enough to drink, its hem in water, against a wet ball; with every effect that a scene can
/// have, as the scene reader makes it when no parameter is named that has a default.
Scene costScene();

}  // namespace command
