// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/MeasuredFront.h"
#include "command/scene/Scene.h"

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace command {

/// Which scene, and what of it the command line decides.
struct SceneOptions {
  std::string scene;                  ///< file
  std::string quality;                ///< empty: as the scene says
  std::optional<double> errorBudget;  ///< instead of a quality [-]; none: as the quality says
  std::string solver;                 ///< empty: as the scene says
  std::string precision;              ///< empty: as the scene says
  std::optional<double> duration;     ///< [s]; none: as the scene says
};

// One for each, since not every command has all of them.
void addSceneFile(CLI::App& app, SceneOptions& options);
void addQuality(CLI::App& app, SceneOptions& options,
                const std::string& explanation = "Substeps and iterations, as for `wetcloth run`");
void addDuration(CLI::App& app, SceneOptions& options);
void addScenePrecision(CLI::App& app, SceneOptions& options);

/// What --precision says, or the scene. Throws InputError when the scene cannot be read.
PrecisionWish wishOf(const SceneOptions& options);

/// A scene as it is to be run.
struct PreparedScene {
  Scene scene;
  std::optional<SteppingChoice> stepping;  ///< none: the scene's own substeps and iterations
};

/// What is allowed in the scene and hardly ever meant: one line each on standard error.
void tellHints(const Scene& scene);

/// Reads the scene and applies the options. Throws InputError when the scene, its duration or the error budget is not
/// allowed.
PreparedScene prepareScene(const SceneOptions& options);

}  // namespace command
