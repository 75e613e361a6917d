#include "RunCommand.h"

#include "DripRecord.h"
#include "Errors.h"
#include "FrameWriter.h"
#include "JsonOutput.h"
#include "Progress.h"
#include "RunReport.h"
#include "SceneReader.h"
#include "SceneWorld.h"
#include "Sibling.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

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
  explicit Run(const Scene& scene) : m_scene(scene), m_wet(scene), m_plain(scene, SceneWorld::Kind::plainBullet) {}

  const SceneWorld& world() const { return m_wet; }
  void finish() { m_wet.finish(); }
  RunTimes times() const {
    return {m_steps, 1e3 * m_wetSeconds / std::max(1, m_steps), 1e3 * m_plainSeconds / std::max(1, m_plainSteps)};
  }

  void step() {
    m_wetSeconds += secondsOf(m_wet);
    ++m_steps;
    if (!m_wet.isFinite()) {
      char when[96];
      std::snprintf(when, sizeof when, "the state became non-finite in step %d (t = %g s)", m_steps,
                    m_steps * m_scene.step);
      throw RunError(m_scene.file + ": " + when + "; try more substeps or a smaller step_s");
    }
    if (!m_plain.isFinite()) return;
    m_plainSeconds += secondsOf(m_plain);
    ++m_plainSteps;
  }

 private:
  const Scene& m_scene;
  SceneWorld m_wet;
  SceneWorld m_plain;
  int m_steps = 0;
  int m_plainSteps = 0;
  double m_wetSeconds = 0;
  double m_plainSeconds = 0;
};

Scene sceneOf(const RunOptions& options, char** arguments) {
  Scene scene = readScene(options.scene);
  if (options.precision.empty()) {
    continueInPrecision(scene.precision, scene.file + ": /precision", arguments);
  } else {
    continueInPrecision(valueOf(precisionNames(), options.precision), "wetcloth: --precision", arguments);
  }
  if (options.duration) scene.duration = *options.duration;
  scaleQuality(scene, valueOf(qualityNames(), options.quality));
  return scene;
}

}  // namespace

const std::vector<std::pair<std::string, Quality>>& qualityNames() {
  static const std::vector<std::pair<std::string, Quality>> names{{"draft", Quality::draft},
                                                                  {"realtime", Quality::realtime},
                                                                  {"accurate", Quality::accurate},
                                                                  {"reference", Quality::reference}};
  return names;
}

void scaleQuality(Scene& scene, Quality quality) {
  const double factor = quality == Quality::draft       ? 0.5
                        : quality == Quality::accurate  ? 2
                        : quality == Quality::reference ? 4
                                                        : 1;
  scene.substeps = std::max(1, static_cast<int>(scene.substeps * factor));
  scene.iterations = std::max(1, static_cast<int>(scene.iterations * factor));
}

void runScene(const RunOptions& options, char** arguments) {
  const Scene scene = sceneOf(options, arguments);
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
  const RunReport report(run.world(), run.times(), options.quality, drips);
  output.write(report.json());
  if (output.ownsStandardOutput()) return;
  std::fputs(report.summary().c_str(), stdout);
  if (frames.isOn()) std::printf("%-15s%d pictures in %s\n", "frames", frames.count(), options.frames.c_str());
}

}  // namespace runner
