// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/EffectCatalogue.h"
#include "command/scene/Scene.h"

#include <string>

namespace command {

/// Reads a scene from a JSON file (docs/scenes.md). Throws InputError with one line that names the file, the JSON
/// pointer, the value and what is allowed.
Scene readScene(const std::string& file, const EffectCatalogue& catalogue = effectCatalogue());

/// The scene's precision, and where it says so; nothing else of it is read. Throws InputError.
PrecisionWish readPrecision(const std::string& file);

}  // namespace command
