// SPDX-License-Identifier: Zlib
#include "command/cost/CostCommand.h"

#include "command/cli/JsonOutput.h"
#include "command/cli/Progress.h"
#include "command/cli/Sibling.h"
#include "command/cost/CostReport.h"
#include "command/cost/CostRun.h"
#include "command/cost/CostScene.h"
#include "command/scene/SceneReader.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace command {
namespace {

constexpr int mostSteps = 300;        // more do not make the medians any steadier
constexpr double secondsAllowed = 8;  // unless --steps says how many

Scene sceneOf(const CostOptions& options, char** arguments) {
  Scene scene = options.scene.empty() ? costScene() : readScene(options.scene);
  if (options.precision.empty()) {
    continueInPrecision(scene.precision, scene.file + ": /precision", arguments);
  } else {
    continueInPrecision(valueOf(precisionNames(), options.precision), "wetcloth: --precision", arguments);
  }
  // An effect acts once in each of Bullet's steps, however many of them the scene calls one.
  scene.step /= scene.substeps;
  scene.substeps = 1;
  return scene;
}

}  // namespace

void measureCost(const CostOptions& options, char** arguments) {
  const Scene scene = sceneOf(options, arguments);
  JsonOutput output(options.json);
  const auto start = std::chrono::steady_clock::now();
  const int steps = options.steps.value_or(mostSteps);
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

}  // namespace command
