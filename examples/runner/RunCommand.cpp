#include "RunCommand.h"

#include "DripRecord.h"
#include "Errors.h"
#include "FiniteState.h"
#include "FrameWriter.h"
#include "JsonOutput.h"
#include "Progress.h"
#include "Quality.h"
#include "RunReport.h"
#include "SceneWorld.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

namespace runner {
namespace {

double secondsOf(SceneWorld& world) {
  const auto start = std::chrono::steady_clock::now();
  world.step();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Steps the scene and, beside it, the same scene in plain Bullet. The two take turns, so that whatever else the
/// machine does slows both.
class Run {
 public:
  explicit Run(const Scene& scene) : m_wet(scene), m_plain(scene, SceneWorld::Kind::plainBullet) {}

  const SceneWorld& world() const { return m_wet; }
  void finish() { m_wet.finish(); }
  RunTimes times() const {
    return {m_steps, 1e3 * m_wetSeconds / std::max(1, m_steps), 1e3 * m_plainSeconds / std::max(1, m_plainSteps)};
  }

  void step() {
    m_wetSeconds += secondsOf(m_wet);
    ++m_steps;
    requireFinite(m_wet, m_steps);
    if (!m_plain.isFinite()) return;
    m_plainSeconds += secondsOf(m_plain);
    ++m_plainSteps;
  }

 private:
  SceneWorld m_wet;
  SceneWorld m_plain;
  int m_steps = 0;
  int m_plainSteps = 0;
  double m_wetSeconds = 0;
  double m_plainSeconds = 0;
};

/// None when the scene decides by itself. Throws InputError when nothing that was measured is within the budget.
std::optional<SteppingChoice> chooseStepping(const RunOptions& options, Scene& scene) {
  if (!options.errorBudget) {
    if (scene.quality.empty()) return std::nullopt;
    return steppingOf(scene, valueOf(qualityNames(), scene.quality));
  }
  const SteppingChoice choice = cheapestStepping(studiesOf(scene), *options.errorBudget);
  if (!(choice.largestError() <= *options.errorBudget)) {
    char text[240];
    std::snprintf(text, sizeof text,
                  "wetcloth: --error-budget = %g: must be at least %.2g for this scene, which %s of %s allows",
                  *options.errorBudget, choice.largestError(), choice.worst().study.study.c_str(),
                  choice.worst().study.method.c_str());
    throw InputError(text);
  }
  apply(choice, scene);
  scene.quality = "error budget";
  return choice;
}

}  // namespace

void runScene(const RunOptions& options, char** arguments) {
  Scene scene = readScene(options, arguments);
  const std::optional<SteppingChoice> stepping = chooseStepping(options, scene);
  JsonOutput output(options.json);
  const int steps = std::max(1, static_cast<int>(std::lround(scene.duration / scene.step)));
  FrameWriter frames(options.frames, options.frameCount, steps);
  Run run(scene);
  DripRecord drips(steps);
  {
    Progress progress("running " + scene.name);
    frames.offer(run.world(), 0);
    for (int step = 1; step <= steps; ++step) {
      run.step();
      drips.note(run.world());
      frames.offer(run.world(), step);
      progress.update(static_cast<double>(step) / steps);
    }
    frames.write(run.world());
  }
  run.finish();
  RunReport report(run.world(), run.times(), drips);
  if (stepping) report.explain(*stepping);
  output.write(report.json());
  if (output.ownsStandardOutput()) return;
  std::fputs(report.summary().c_str(), stdout);
  if (frames.isOn()) std::printf("%-15s%d pictures in %s\n", "frames", frames.count(), options.frames.c_str());
}

}  // namespace runner
