// SPDX-License-Identifier: Zlib
#include "command/scene/SceneOptions.h"

#include "command/cli/CommonOptions.h"
#include "command/cli/Errors.h"
#include "command/scene/Quality.h"
#include "command/scene/SceneReader.h"
#include "command/scene/SolverOption.h"

#include <cstdio>

namespace command {
namespace {

void requireDuration(double duration, double step) {
  if (duration > 0 && duration / step <= mostSteps) return;
  char text[120];
  std::snprintf(text, sizeof text, "wetcloth: --duration = %g: must be > 0 and at most %g s, 2e9 steps", duration,
                mostSteps * step);
  throw InputError(text);
}

/// Throws InputError when nothing that was measured is within the budget.
SteppingChoice steppingWithinBudget(const Scene& scene, double budget) {
  const SteppingChoice choice = steppingWithin(scene, budget);
  if (choice.largestError() <= budget) return choice;
  char text[240];
  std::snprintf(text, sizeof text,
                "wetcloth: --error-budget = %g: must be at least %.2g for this scene, which %s of %s allows", budget,
                choice.largestError(), choice.worst().study.study.c_str(), choice.worst().study.method.c_str());
  throw InputError(text);
}

/// Errors were measured on Bullet's own solver alone.
void requireMeasured(const Scene& scene, double budget) {
  if (!scene.clothSolver) return;
  char text[120];
  std::snprintf(text, sizeof text, "wetcloth: --error-budget = %g: must be left out with the solver wetcloth", budget);
  throw InputError(text);
}

/// None when the scene decides by itself.
std::optional<SteppingChoice> chooseStepping(const SceneOptions& options, Scene& scene) {
  std::optional<SteppingChoice> choice;
  if (options.errorBudget) {
    requireMeasured(scene, *options.errorBudget);
    choice = steppingWithinBudget(scene, *options.errorBudget);
    scene.quality = "error budget";
  } else if (!scene.quality.empty()) {
    choice = steppingWithin(scene, allowedError(valueOf(qualityNames(), scene.quality)));
  }
  if (choice) apply(*choice, scene);
  return choice;
}

}  // namespace

void addSceneFile(CLI::App& app, SceneOptions& options) {
  app.add_option("scene", options.scene, "Scene file (JSON, see docs/scenes.md)")->required();
}

void addQuality(CLI::App& app, SceneOptions& options, const std::string& explanation) {
  app.add_option("--quality", options.quality, explanation)->check(oneOf("--quality", namesOf(qualityNames())));
}

void addDuration(CLI::App& app, SceneOptions& options) {
  app.add_option("--duration", options.duration, "Simulated time [s], instead of the scene's own");
}

void addScenePrecision(CLI::App& app, SceneOptions& options) {
  addPrecision(app, options.precision, "Instead of the scene's own");
}

PrecisionWish wishOf(const SceneOptions& options) {
  return options.precision.empty() ? readPrecision(options.scene) : wishOf(options.precision);
}

void tellHints(const Scene& scene) {
  for (const std::string& hint : scene.hints) std::fprintf(stderr, "%s\n", hint.c_str());
}

PreparedScene prepareScene(const SceneOptions& options) {
  Scene scene = readScene(options.scene);
  if (options.duration) requireDuration(*options.duration, scene.step);
  tellHints(scene);
  if (options.duration) scene.duration = *options.duration;
  applySolver(options.solver, scene.world, scene.clothSolver);
  if (!options.quality.empty()) scene.quality = options.quality;
  std::optional<SteppingChoice> stepping = chooseStepping(options, scene);
  return {std::move(scene), std::move(stepping)};
}

}  // namespace command
