// SPDX-License-Identifier: Zlib
#include "command/render/RenderCommand.h"

#include "command/cli/CommonOptions.h"
#include "command/cli/DistinctFiles.h"
#include "command/cli/Errors.h"
#include "command/cli/JsonOutput.h"
#include "command/cli/NearestWord.h"
#include "command/cli/StagedOutput.h"
#include "command/render/DrawnPictures.h"
#include "command/render/PictureSize.h"
#include "command/render/RenderJob.h"
#include "command/render/SampleRun.h"
#include "command/scene/DryScene.h"
#include "command/scene/SceneOptions.h"
#include "command/scene/SolverOption.h"

#include "command/pictures/HtmlPage.h"
#include "command/pictures/Unavailable.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace command {
namespace {

using pictures::Colouring;

struct RenderOptions : SceneOptions {
  std::string out;   ///< file; its suffix chooses what is made
  std::string size;  ///< WIDTHxHEIGHT [pixels]; empty: as fits what is made
  std::optional<double> framesPerSecond;
  double speed = 1;                   ///< simulated seconds per second of film
  std::vector<double> times;          ///< of a picture [s]; none: the end
  std::vector<double> view;           ///< direction that the camera looks along; none: as the scene says
  double orbit = 0;                   ///< turn of the camera about the upright [degrees]
  std::optional<double> fieldOfView;  ///< vertical [degrees]
  std::string colouring = "fabric";
  bool compare = false;  ///< plain Bullet, dry and wet side by side
  std::string json;
};

const NamedValues<Colouring>& colourings() {
  static const NamedValues<Colouring> all{{"fabric", Colouring::fabric},
                                          {"saturation", Colouring::saturation},
                                          {"stretch", Colouring::stretch},
                                          {"speed", Colouring::speed}};
  return all;
}

/// What a suffix stands for.
struct Product {
  std::string suffix;
  bool isFilm;
  double framesPerSecond;  ///< of a film, unless the user wants others
  std::string size;        ///< unless the user wants another
  bool hasEvenSize;
  void (*require)(int width, int height);  ///< throws Unavailable before a long run, not after it
  RenderResult (*write)(const RenderJob&);
};

void requireNothing(int /*width*/, int /*height*/) {}

RenderResult writePage(const RenderJob& job) {
  pictures::writeHtml(job.panels.back().sequence, job.path);
  return {};
}

const std::vector<Product>& products() {
  static const std::vector<Product> all{{".png", false, 0, "1280x720", false, requirePng, drawPng},
                                        {".mp4", true, 30, "1280x720", true, requireFilm, drawFilm},
                                        {".webm", true, 30, "1280x720", true, requireFilm, drawFilm},
                                        {".gif", true, 25, "640x360", false, requireFilm, drawFilm},
                                        {".html", true, 30, "1280x720", false, requireNothing, writePage}};
  return all;
}

std::vector<std::string> renderSuffixes() {
  std::vector<std::string> suffixes;
  for (const Product& product : products()) suffixes.push_back(product.suffix);
  return suffixes;
}

std::string nameOfOut(const RenderOptions& options) { return "wetcloth: --out = \"" + onOneLine(options.out) + "\""; }

const Product& productOf(const RenderOptions& options) {
  const std::string suffix = std::filesystem::path(options.out).extension().string();
  for (const Product& product : products()) {
    if (product.suffix == suffix) return product;
  }
  throw InputError(nameOfOut(options) + ": must end in one of " + joined(renderSuffixes()));
}

[[noreturn]] void refuse(const std::string& option, double value, const std::string& allowed) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  throw InputError("wetcloth: " + option + " = " + text + ": must be " + allowed);
}

void requireOptions(const RenderOptions& options, const Product& product) {
  const double framesPerSecond = options.framesPerSecond.value_or(30);
  if (!(framesPerSecond >= 1 && framesPerSecond <= 240)) refuse("--fps", framesPerSecond, "in [1, 240]");
  if (!(options.speed >= 1e-3 && options.speed <= 1e3)) refuse("--speed", options.speed, "in [0.001, 1000]");
  if (!(std::abs(options.orbit) <= 360)) refuse("--orbit", options.orbit, "in [-360, 360] degrees");
  const double fieldOfView = options.fieldOfView.value_or(30);
  if (!(fieldOfView >= 1 && fieldOfView <= 120)) refuse("--field-of-view", fieldOfView, "in [1, 120] degrees");
  for (const double part : options.view) {
    if (!std::isfinite(part)) refuse("--view", part, "three finite numbers");
  }
  if (!options.view.empty() && std::hypot(options.view[0], options.view[1], options.view[2]) < 1e-6) {
    refuse("--view", 0, "a direction, not all zero");
  }
  if (product.write == writePage && options.compare) {
    throw InputError("wetcloth: --compare: must be left out for a page, which shows one run");
  }
  if (product.isFilm && !options.times.empty()) refuse("--times", options.times[0], "left out for a film");
}

void requireTimes(const RenderOptions& options, const Scene& scene) {
  for (std::size_t i = 0; i < options.times.size(); ++i) {
    const double time = options.times[i];
    const bool isLater = i == 0 || time > options.times[i - 1];
    if (time >= 0 && time <= scene.duration && isLater) continue;
    char allowed[96];
    std::snprintf(allowed, sizeof allowed, "in [0, %g] s, the scene's duration, each later than the one before",
                  scene.duration);
    refuse("--times", time, allowed);
  }
}

/// The moments of the run that are shown [s].
std::vector<double> timesOf(const RenderOptions& options, const Product& product, const Scene& scene) {
  if (!product.isFilm) return options.times.empty() ? std::vector<double>{scene.duration} : options.times;
  const double interval = options.speed / options.framesPerSecond.value_or(product.framesPerSecond);
  std::vector<double> times;
  const double count = std::floor(scene.duration / interval + 1e-6);
  if (count > 100000) refuse("--speed", options.speed, "such that the film has at most 100000 pictures");
  for (int i = 0; i <= static_cast<int>(count); ++i) times.push_back(std::min(i * interval, scene.duration));
  return times;
}

void aimCamera(const RenderOptions& options, Scene& scene) {
  btVector3& direction = scene.camera.direction;
  if (!options.view.empty()) {
    const std::vector<double>& view = options.view;
    const double largest = std::max({std::abs(view[0]), std::abs(view[1]), std::abs(view[2])});
    const auto part = [&](std::size_t axis) { return btScalar(view[axis] / largest); };
    direction = btVector3(part(0), part(1), part(2)).normalized();
  }
  direction = direction.rotate(scene.up(), btScalar(options.orbit * 3.14159265358979 / 180));
  if (options.fieldOfView) scene.camera.fieldOfView = *options.fieldOfView;
}

std::vector<Panel> samplePanels(const RenderOptions& options, const Scene& scene, const std::vector<double>& times) {
  std::vector<Panel> panels;
  if (options.compare) {
    panels.push_back({"plain Bullet", sampleRun(scene, times, SceneWorld::Kind::plainBullet)});
    panels.push_back({"dry", sampleRun(dryScene(scene), times)});
  }
  panels.push_back({options.compare ? "wet" : "", sampleRun(scene, times)});
  return panels;
}

/// Calls `action`; what it lacks is bad usage, and what goes wrong with it is a run that failed.
template <class Action>
auto atOut(const RenderOptions& options, const Action& action) {
  try {
    return action();
  } catch (const pictures::Unavailable& missing) {
    throw InputError(nameOfOut(options) + ": " + onOneLine(missing.what()));
  } catch (const std::runtime_error& error) {
    throw RunError(nameOfOut(options) + ": " + onOneLine(error.what()));
  }
}

double speedOfDrawing(const RenderJob& job, const RenderResult& result) {
  return static_cast<double>(job.panels.front().sequence.frames.size()) / std::max(1e-9, result.secondsOfDrawing);
}

nlohmann::ordered_json jsonOf(const RenderOptions& options, const Scene& scene, const RenderJob& job,
                              const RenderResult& result) {
  const std::vector<pictures::Frame>& frames = job.panels.back().sequence.frames;
  nlohmann::ordered_json json{{"scene", scene.name},         {"precision", nameOf(ownPrecision)},
                              {"file", options.out},         {"bytes", std::filesystem::file_size(options.out)},
                              {"frames", frames.size()},     {"first_s", frames.front().time},
                              {"last_s", frames.back().time}};
  if (job.framesPerSecond > 0) json["fps"] = job.framesPerSecond;
  if (result.renderer.empty()) return json;
  json["width"] = result.width;
  json["height"] = result.height;
  json["frames_drawn_per_second"] = speedOfDrawing(job, result);
  json["renderer"] = result.renderer;
  return json;
}

void printSummary(const RenderOptions& options, const RenderJob& job, const RenderResult& result) {
  const std::size_t count = job.panels.front().sequence.frames.size();
  const char* const pictures = count == 1 ? "picture" : "pictures";
  if (result.renderer.empty()) {
    std::printf("%s: %zu %s\n", options.out.c_str(), count, pictures);
    return;
  }
  std::printf("%s: %zu %s, %d x %d pixels\n", options.out.c_str(), count, pictures, result.width, result.height);
  std::printf("drawn at %.1f pictures a second by %s\n", speedOfDrawing(job, result), result.renderer.c_str());
}

void renderScene(const RenderOptions& options) {
  const Product& product = productOf(options);
  requireOptions(options, product);
  requireDistinctFiles({{"the scene", options.scene}, {"--json", options.json}, {"--out", options.out}});
  const PictureSize size = readSize(options.size.empty() ? product.size : options.size, product.hasEvenSize);
  Scene scene = prepareScene(options).scene;
  requireTimes(options, scene);
  aimCamera(options, scene);
  JsonOutput json(options.json);
  StagedOutput output(nameOfOut(options), options.out, StagedOutput::Kind::file);
  atOut(options, [&] { product.require(size.width, size.height); });
  RenderJob job{output.path(), {}, size.width, size.height, 0, valueOf(colourings(), options.colouring)};
  if (product.isFilm) job.framesPerSecond = options.framesPerSecond.value_or(product.framesPerSecond);
  job.panels = samplePanels(options, scene, timesOf(options, product, scene));
  const RenderResult result = atOut(options, [&] { return product.write(job); });
  output.commit();
  json.write(jsonOf(options, scene, job, result));
  if (!json.ownsStandardOutput()) printSummary(options, job, result);
}

void addCameraOptions(CLI::App& app, RenderOptions& options) {
  app.add_option("--view", options.view, "X,Y,Z: what the camera looks along, instead of the scene's own direction")
      ->delimiter(',')
      ->expected(3);
  app.add_option("--orbit", options.orbit, "Turns the camera about the upright [degrees]")->capture_default_str();
  app.add_option("--field-of-view", options.fieldOfView, "Of the camera, vertical [degrees]");
}

}  // namespace

Command addRenderCommand(CLI::App& line) {
  CLI::App* const app =
      line.add_subcommand("render", "Run a scene and draw pictures, a film or a page for a browser, without a display");
  const auto options = std::make_shared<RenderOptions>();
  addSceneFile(*app, *options);
  app->add_option("--out", options->out, "File, which is replaced; its suffix chooses: " + joined(renderSuffixes()))
      ->required();
  app->add_option("--size", options->size,
                  "WIDTHxHEIGHT of the film or of each picture [pixels]; default 1280x720, for a .gif 640x360");
  app->add_option("--times", options->times, "Of a .png: when [s]; several give a strip; default is the end")
      ->delimiter(',');
  app->add_option("--fps", options->framesPerSecond,
                  "Of a film or page: pictures per second; default 30, for a .gif 25");
  app->add_option("--speed", options->speed, "Of a film: simulated seconds per second of film; 0.25 is slow motion")
      ->capture_default_str();
  addCameraOptions(*app, *options);
  app->add_option("--colouring", options->colouring, "What the colours of a cloth show; all but fabric with a bar")
      ->check(oneOf("--colouring", namesOf(colourings())))
      ->capture_default_str();
  app->add_flag("--compare", options->compare, "Plain Bullet, the dry scene and the wet one side by side");
  addDuration(*app, *options);
  addQuality(*app, *options);
  addSolver(*app, options->solver);
  addScenePrecision(*app, *options);
  addJson(*app, options->json, "what was drawn");
  return {app, [options] { renderScene(*options); }, [options] { return wishOf(*options); }};
}

}  // namespace command
