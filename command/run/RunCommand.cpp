// SPDX-License-Identifier: Zlib
#include "command/run/RunCommand.h"

#include "command/cli/CommonOptions.h"
#include "command/cli/DistinctFiles.h"
#include "command/cli/Errors.h"
#include "command/cli/JsonOutput.h"
#include "command/cli/Progress.h"
#include "command/run/Checkpoint.h"
#include "command/run/DripRecord.h"
#include "command/run/FrameWriter.h"
#include "command/run/RunReport.h"
#include "command/run/SmallStepFile.h"
#include "command/scene/SceneOptions.h"
#include "command/scene/SceneWorld.h"
#include "command/scene/SolverOption.h"
#include "command/scene/SoundState.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

namespace command {
namespace {

struct RunOptions : SceneOptions {
  std::string frames;  ///< directory; empty: no pictures
  int frameCount = 12;
  std::string json;
  std::string checkpoint;  ///< file; empty: none
  int every = 100;         ///< steps of the scene from one checkpoint to the next
  std::string resume;      ///< file; empty: from the start
  std::string smallSteps;  ///< file; empty: none
  bool isAlone = false;    ///< without plain Bullet beside it
};

/// The wall clock's time of a world's steps: of those that this program made, for a checkpoint holds no times.
class StepTime {
 public:
  void step(SceneWorld& world, const SceneWorld::BeforeSubstep& before = {}) {
    const auto start = std::chrono::steady_clock::now();
    world.step(before);
    m_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ++m_steps;
  }
  double meanMilliseconds() const { return 1e3 * m_seconds / std::max(1, m_steps); }

 private:
  double m_seconds = 0;
  int m_steps = 0;
};

/// Steps the scene and, unless it is to be alone, beside it the same scene in plain Bullet. The two take turns, so that
/// whatever else the machine does slows both.
class Run {
 public:
  /// @param steps  of the whole run
  Run(const Scene& scene, int steps, bool isAlone) : m_wet(scene), m_drips(steps) {
    if (!isAlone) m_plain.emplace(scene, SceneWorld::Kind::plainBullet);
  }

  const SceneWorld& world() const { return m_wet; }
  const DripRecord& drips() const { return m_drips; }
  int steps() const { return m_steps; }
  void finish() { m_wet.finish(); }
  /// From the next step on.
  void writeSmallSteps(SmallStepFile& file) {
    file.follow(m_wet);
    m_beforeSubstep = [&file](btScalar) { file.beginSubstep(); };
  }
  RunTimes times() const {
    RunTimes times{m_steps, m_wetTime.meanMilliseconds(), std::nullopt};
    if (m_plain) times.plainMilliseconds = m_plainTime.meanMilliseconds();
    return times;
  }

  void step() {
    m_wetTime.step(m_wet, m_beforeSubstep);
    ++m_steps;
    requireSound(m_wet);
    m_drips.note(m_wet);
    if (m_plain && !m_plain->blowUp()) m_plainTime.step(*m_plain);
  }

  /// Fills in how far the run is. Throws RunError when this scene's state cannot be saved.
  void save(Checkpoint& checkpoint) const {
    std::ostringstream state;
    try {
      m_wet.save(state);
    } catch (const wetcloth::StateError& error) {
      throw RunError(std::string("wetcloth: --checkpoint: ") + error.what());
    }
    checkpoint.state = state.str();
    checkpoint.progress = {{"steps", m_steps}, {"drips", m_drips.progress()}};
  }
  /// Goes on from there; plain Bullet, which is there for its time alone, from where the wet cloth is. Throws
  /// wetcloth::StateError, or a JSON exception.
  void restore(const Checkpoint& checkpoint) {
    const nlohmann::ordered_json& progress = checkpoint.progress;
    m_steps = progress.at("steps").get<int>();
    m_drips.goOnFrom(progress.at("drips"), m_steps);
    std::istringstream state(checkpoint.state);
    m_wet.restore(state, m_steps);
    if (m_plain) m_plain->continueFrom(m_wet);
  }

 private:
  SceneWorld m_wet;
  std::optional<SceneWorld> m_plain;
  DripRecord m_drips;
  StepTime m_wetTime;
  StepTime m_plainTime;
  SceneWorld::BeforeSubstep m_beforeSubstep;
  int m_steps = 0;
};

void resume(Run& run, const std::string& path, const nlohmann::ordered_json& identity) {
  const Checkpoint checkpoint = readCheckpoint(path, identity);
  try {
    run.restore(checkpoint);
  } catch (const nlohmann::json::exception&) {
    throw InputError(onOneLine("wetcloth: --resume = \"" + path + "\": is no checkpoint of this version of wetcloth"));
  } catch (const std::exception& error) {
    throw InputError(onOneLine("wetcloth: --resume = \"" + path + "\": " + error.what()));
  }
}

/// The steps from where the run is to its end.
void stepToEnd(Run& run, int steps, const RunOptions& options, const nlohmann::ordered_json& identity,
               FrameWriter& frames) {
  Progress progress("running " + run.world().scene().name);
  frames.offer(run.world(), run.steps());
  while (run.steps() < steps) {
    run.step();
    frames.offer(run.world(), run.steps());
    if (!options.checkpoint.empty() && run.steps() % options.every == 0) {
      Checkpoint checkpoint;
      checkpoint.run = identity;
      run.save(checkpoint);
      writeCheckpoint(options.checkpoint, checkpoint);
    }
    progress.update(static_cast<double>(run.steps()) / steps);
  }
  frames.write(run.world());
}

void requireOptions(const RunOptions& options) {
  if (options.frameCount < 1 || options.frameCount > 10000) {
    throw InputError("wetcloth: --frame-count = " + std::to_string(options.frameCount) + ": must be 1 to 10000");
  }
  if (options.errorBudget && !options.quality.empty()) {
    throw InputError("wetcloth: --error-budget and --quality: give one of the two");
  }
  if (options.every < 1) {
    throw InputError("wetcloth: --every = " + std::to_string(options.every) + ": must be at least 1");
  }
}

void runScene(const RunOptions& options) {
  requireOptions(options);
  requireDistinctFiles({{"the scene", options.scene},
                        {"--json", options.json},
                        {"--checkpoint", options.checkpoint},
                        {"--small-steps", options.smallSteps}});
  const PreparedScene prepared = prepareScene(options);
  const Scene& scene = prepared.scene;
  JsonOutput output(options.json);
  const int steps = std::max(1, static_cast<int>(std::lround(scene.duration / scene.step)));
  FrameWriter frames(options.frames, options.frameCount, steps);
  SmallStepFile smallSteps(options.smallSteps, scene);
  if (!options.checkpoint.empty()) requireCheckpointPlace(options.checkpoint);
  const nlohmann::ordered_json identity = runIdentity(scene, steps);
  Run run(scene, steps, options.isAlone);
  if (!options.resume.empty()) resume(run, options.resume, identity);
  run.writeSmallSteps(smallSteps);
  stepToEnd(run, steps, options, identity, frames);
  run.finish();
  smallSteps.finish();
  RunReport report(run.world(), run.times(), run.drips());
  if (prepared.stepping && !scene.clothSolver) report.explain(*prepared.stepping);
  output.write(report.json());
  if (output.ownsStandardOutput()) return;
  std::fputs(report.summary().c_str(), stdout);
  if (frames.isOn()) std::printf("%-15s%d pictures in %s\n", "frames", frames.count(), options.frames.c_str());
}

void addCheckpointOptions(CLI::App& app, RunOptions& options, CLI::Option* frames) {
  CLI::Option* const checkpoint = app.add_option(
      "--checkpoint", options.checkpoint, "File that is replaced now and then by the run as it is, for --resume");
  app.add_option("--every", options.every, "Steps of the scene from one checkpoint to the next")
      ->capture_default_str()
      ->needs(checkpoint);
  app.add_option("--resume", options.resume, "Checkpoint to go on from; the run ends as if it had not been interrupted")
      ->excludes(frames);
}

}  // namespace

Command addRunCommand(CLI::App& line) {
  CLI::App* const app = line.add_subcommand("run", "Run a scene");
  const auto options = std::make_shared<RunOptions>();
  addSceneFile(*app, *options);
  CLI::Option* const frames =
      app->add_option("--frames", options->frames, "Directory for pictures of the run, frame_0000.svg and so on");
  app->add_option("--frame-count", options->frameCount, "How many pictures, evenly spaced")
      ->capture_default_str()
      ->needs(frames);
  addJson(*app, options->json);
  addQuality(*app, *options,
             "Substeps and iterations, instead of the scene's own: the cheapest that were measured within 10 % "
             "(draft), 3 % (realtime) and 1 % (accurate), and the most accurate ones (reference); "
             "see docs/accuracy.md");
  app->add_option("--error-budget", options->errorBudget,
                  "The same for an error of your own, e.g. 1e-2, in all that the scene's effects were measured by");
  addCheckpointOptions(*app, *options, frames);
  addDuration(*app, *options);
  addSolver(*app, options->solver);
  app->add_flag(
      "--no-comparison", options->isAlone,
      "Without the same scene in plain Bullet beside it: less time and memory, and bullet_ms_per_step is not told");
  app->add_option("--small-steps", options->smallSteps,
                  "File for the nodes' places after each small step of the solver wetcloth; see docs/scenes.md");
  addScenePrecision(*app, *options);
  return {app, [options] { runScene(*options); }, [options] { return wishOf(*options); }};
}

}  // namespace command
