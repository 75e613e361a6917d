// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <optional>
#include <string>

namespace command {

/// Which scene, and what of it the command line decides.
struct SceneOptions {
  std::string scene;               ///< file
  std::string quality;             ///< empty: as the scene says
  std::string precision;           ///< empty: as the scene says
  std::optional<double> duration;  ///< [s]; none: as the scene says
};

/// The scene as it is to be run. Does not return when the other precision is wanted: see continueInPrecision(). Throws
/// InputError when the scene or its duration is not allowed.
Scene readScene(const SceneOptions& options, char** arguments);

}  // namespace command
