// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/EffectCatalogue.h"
#include "command/scene/Scene.h"

#include <string>

namespace command {

/// Reads a scene from a JSON file (docs/scenes.md); a bare name that is not in the working directory is looked for
/// among the scenes that go with the command. Throws InputError with one line that names the file, the JSON pointer,
/// the value and what is allowed.
Scene readScene(const std::string& given, const EffectCatalogue& catalogue = effectCatalogue());

/// The same of what such a file holds. @param file  that complaints name, and that files of the scene are found beside
Scene readScene(const Json& json, const std::string& file, const EffectCatalogue& catalogue = effectCatalogue());

/// The scene's precision, and where it says so; nothing else of it is read. Throws InputError.
PrecisionWish readPrecision(const std::string& given);

}  // namespace command
