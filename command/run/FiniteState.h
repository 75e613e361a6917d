// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/SceneWorld.h"

namespace command {

/// Throws RunError that says when, if a position or velocity is no longer finite. @param step number of the last one
void requireFinite(const SceneWorld& world, int step);

}  // namespace command
