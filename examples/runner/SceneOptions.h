#pragma once

#include "Scene.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace runner {

enum class Quality { draft, realtime, accurate, reference };
const std::vector<std::pair<std::string, Quality>>& qualityNames();
/// Substeps and iterations, both: half as many, as many, 2 and 4 times as many.
void scaleQuality(Scene& scene, Quality quality);

/// Which scene, and what of it the command line decides.
struct SceneOptions {
  std::string scene;  ///< file
  std::string quality = "realtime";
  std::string precision;           ///< empty: as the scene says
  std::optional<double> duration;  ///< [s]; none: as the scene says
};

/// The scene as it is to be run. Does not return when the other precision is wanted: see continueInPrecision(). Throws
/// InputError when the scene or its duration is not allowed.
Scene readScene(const SceneOptions& options, char** arguments);

}  // namespace runner
