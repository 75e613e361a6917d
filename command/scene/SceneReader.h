// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <string>

namespace command {

/// Reads a scene from a JSON file (docs/scenes.md). Throws InputError with one line that names the file, the JSON
/// pointer, the value and what is allowed.
Scene readScene(const std::string& file);

}  // namespace command
