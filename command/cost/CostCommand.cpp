// SPDX-License-Identifier: Zlib
#include "command/cost/CostCommand.h"

#include "command/cli/CommonOptions.h"
#include "command/cli/DistinctFiles.h"
#include "command/cli/Errors.h"
#include "command/cli/JsonOutput.h"
#include "command/cli/Progress.h"
#include "command/cost/CostReport.h"
#include "command/cost/CostRun.h"
#include "command/cost/CostScene.h"
#include "command/scene/SceneOptions.h"
#include "command/scene/SceneReader.h"
#include "command/scene/SolverOption.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

namespace command {
namespace {

struct CostOptions {
  std::string scene;         ///< empty: the built-in one
  std::string solver;        ///< empty: as the scene says
  std::string precision;     ///< empty: as the scene says
  std::optional<int> steps;  ///< of Bullet, measured in each world; none: as many as fit into some seconds
  std::string json;
};

constexpr int enoughSteps = 300;      // more do not make the medians any steadier
constexpr double secondsAllowed = 8;  // unless --steps says how many

PrecisionWish precisionOf(const CostOptions& options) {
  const bool doesSceneSay = options.precision.empty() && !options.scene.empty();
  return doesSceneSay ? readPrecision(options.scene) : wishOf(options.precision);
}

Scene sceneOf(const CostOptions& options) {
  Scene scene = options.scene.empty() ? costScene() : readScene(options.scene);
  tellHints(scene);
  applySolver(options.solver, scene.world, scene.clothSolver);
  // An effect acts once in each of Bullet's steps, however many of them the scene calls one.
  scene.step /= scene.substeps;
  scene.substeps = 1;
  return scene;
}

void measureCost(const CostOptions& options) {
  if (options.steps && (*options.steps < 1 || *options.steps > 100000)) {
    throw InputError("wetcloth: --steps = " + std::to_string(*options.steps) + ": must be 1 to 100000");
  }
  requireDistinctFiles({{"the scene", options.scene}, {"--json", options.json}});
  const Scene scene = sceneOf(options);
  JsonOutput output(options.json);
  const auto start = std::chrono::steady_clock::now();
  const int steps = options.steps.value_or(enoughSteps);
  CostRun run(scene);
  {
    Progress progress("measuring " + scene.name);
    double done = 0;
    while (done < 1 && run.obstacle().empty()) {
      run.turn(steps - run.steps());
      done = static_cast<double>(run.steps()) / steps;
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
      if (!options.steps) done = std::max(done, elapsed.count() / secondsAllowed);
      progress.update(std::min(1.0, done));
    }
  }
  const CostReport report(run);
  output.write(report.json());
  if (!output.ownsStandardOutput()) std::fputs(report.text().c_str(), stdout);
}

}  // namespace

Command addCostCommand(CLI::App& line) {
  CLI::App* const app =
      line.add_subcommand("cost", "Measure what each effect and the guard take, beside Bullet's own step");
  const auto options = std::make_shared<CostOptions>();
  app->add_option("scene", options->scene, "Scene file; default is a cloth of 64 x 64 nodes with every effect");
  app->add_option("--steps", options->steps,
                  "Bullet's steps to measure in each world; default is what 8 s allow, at most 300");
  addSolver(*app, options->solver,
            "Who steps the cloths, instead of the scene's choice, with its numbers; plain Bullet stays on its own");
  addPrecision(*app, options->precision, "Instead of the scene's own");
  addJson(*app, options->json);
  return {app, [options] { measureCost(*options); }, [options] { return precisionOf(*options); }};
}

}  // namespace command
