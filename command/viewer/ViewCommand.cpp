// SPDX-License-Identifier: Zlib
#include "command/viewer/ViewCommand.h"

#include "command/viewer/LiveScene.h"
#include "command/viewer/Player.h"

#include "command/cli/CommonOptions.h"
#include "command/cli/Errors.h"
#include "command/cli/JsonOutput.h"
#include "command/cli/StagedOutput.h"
#include "command/run/StateHash.h"
#include "command/scene/SceneOptions.h"
#include "command/scene/SolverOption.h"

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace viewer {
namespace {

struct ViewOptions : command::SceneOptions {
  std::string size = "1280x800";  ///< of the window [pixels]
  bool paused = false;
  bool compare = false;
  std::optional<int> frames;  ///< closes the window after so many pictures, one step each; none: when told to
  std::string screenshot;     ///< file for the last picture; empty: none
  std::string json;
};

constexpr int smallest = 320;
constexpr int largest = 8192;

std::pair<int, int> sizeOf(const std::string& text) {
  int width = 0;
  int height = 0;
  char end = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &end) != 2 || width < smallest || height < smallest ||
      width > largest || height > largest) {
    throw command::InputError("wetcloth: --size = \"" + command::onOneLine(text) +
                              "\": must be WIDTHxHEIGHT in pixels, " + "each from " + std::to_string(smallest) +
                              " to " + std::to_string(largest));
  }
  return {width, height};
}

/// Made before the window opens, so that a slip in the name is told at once; null: no picture is wanted.
std::unique_ptr<command::StagedOutput> pictureOf(const ViewOptions& options) {
  const std::string& file = options.screenshot;
  if (file.empty()) return nullptr;
  const std::string option = "wetcloth: --screenshot = \"" + command::onOneLine(file) + "\"";
  if (file.size() < 5 || file.substr(file.size() - 4) != ".png") {
    throw command::InputError(option + ": must be a file that ends in .png");
  }
  return std::make_unique<command::StagedOutput>(option, file, command::StagedOutput::Kind::file);
}

PlayerOptions playerOptionsOf(const ViewOptions& options) {
  if (options.frames && (*options.frames < 1 || *options.frames > 1000000)) {
    throw command::InputError("wetcloth: --frames = " + std::to_string(*options.frames) + ": must be 1 to 1000000");
  }
  const auto [width, height] = sizeOf(options.size);
  return {width, height, options.frames, ""};
}

nlohmann::ordered_json jsonOf(const LiveScene& live, const PlayerReport& report) {
  nlohmann::ordered_json json;
  json["scene"] = live.scene().name;
  json["precision"] = command::nameOf(command::ownPrecision);
  json["solver"] = command::nameOf(live.scene().solver());
  json["time_s"] = live.time();
  json["steps"] = live.steps();
  json["frames"] = report.frames;
  json["frames_per_second"] = report.framesPerSecond;
  json["paused"] = live.isPaused();
  json["slow_motion"] = report.slowMotion;
  json["compare"] = live.isCompared();
  json["colouring"] = report.colouring;
  json["drags"] = report.drags;
  for (const auto& effect : live.effects().list()) {
    if (effect.isOn) json["effects"].push_back(effect.key);
  }
  json["water_held_kg"] = live.waterHeld();
  json["state_hash"] = command::stateHash(live.world());
  return json;
}

void viewScene(const ViewOptions& options) {
  PlayerOptions playerOptions = playerOptionsOf(options);
  LiveScene live(command::prepareScene(options).scene);
  const auto picture = pictureOf(options);
  requirePlayer();
  command::JsonOutput output(options.json);
  live.setPaused(options.paused);
  live.setCompared(options.compare);
  if (picture) playerOptions.lastPicture = picture->path();
  const PlayerReport report = play(live, playerOptions);
  if (picture) picture->commit();
  output.write(jsonOf(live, report));
}

}  // namespace

command::Command addViewCommand(CLI::App& line) {
  CLI::App* const app = line.add_subcommand("view", "Play with a scene in a window");
  const auto options = std::make_shared<ViewOptions>();
  addSceneFile(*app, *options);
  app->add_option("--size", options->size, "Of the window, WIDTHxHEIGHT [pixels]")->capture_default_str();
  app->add_flag("--paused", options->paused, "Begin paused");
  app->add_flag("--compare", options->compare, "Begin with plain Bullet beside the wet cloth");
  addQuality(*app, *options, "Substeps and iterations, as for `wetcloth run`; the window changes both");
  command::addSolver(*app, options->solver);
  addScenePrecision(*app, *options);
  app->add_option("--frames", options->frames, "Close the window after so many pictures, one step of the scene each");
  app->add_option("--screenshot", options->screenshot, "File for the window's last picture, .png");
  command::addJson(*app, options->json, "how it was left");
  return {app, [options] { viewScene(*options); }, [options] { return wishOf(*options); }};
}

}  // namespace viewer
