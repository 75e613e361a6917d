// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/SceneWorld.h"

#include <string>

namespace command {

/// FNV-1a, 64 bits, over the bytes of all positions, velocities and water: the same scene and the same binary give
/// the same sixteen hexadecimal digits, any number of times.
std::string stateHash(const SceneWorld& world);

}  // namespace command
