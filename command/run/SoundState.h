// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/SceneWorld.h"

namespace command {

/// Throws RunError that says which node, when, and what usually helps, if a cloth has blown up (findBlowUp()).
/// @param step number of the last one
void requireSound(const SceneWorld& world, int step);

}  // namespace command
