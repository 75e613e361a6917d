// SPDX-License-Identifier: Zlib
#include "command/cli/CommandLine.h"

#include "bullet_wetcloth/Version.h"
#include "command/ccd/CcdCommand.h"
#include "command/ccd/CcdMethod.h"
#include "command/cli/Errors.h"
#include "command/cli/NearestWord.h"
#include "command/cost/CostCommand.h"
#include "command/fall/FallCommand.h"
#include "command/plot/PlotCommand.h"
#include "command/render/ExportCommand.h"
#include "command/render/RenderCommand.h"
#include "command/run/RunCommand.h"
#include "command/scene/Quality.h"
#include "command/scene/ValidateCommand.h"

#include "command/accuracy/AccuracyCommand.h"
#include "command/stability/StabilityCommand.h"
#include "command/stability/StabilityTable.h"
#include "command/stability/World.h"
#include "command/viewer/ViewCommand.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace command {
namespace {

const char* const examples = R"(Examples:
  wetcloth fall                                         wet and dry fall against plain Bullet
  wetcloth fall --mode physical --height 5.5 --json -   the same with real cotton, as JSON
  wetcloth run hanging_towel.json                       run a scene and say what came of it
  wetcloth run flag_wind_100.json --frames pictures     and paint it: pictures/frame_0000.svg, ...
  wetcloth run curtain.json --quality accurate --json result.json
  wetcloth run curtain.json --checkpoint curtain.state --every 600    keep where it is; after a crash go on with
  wetcloth run curtain.json --resume curtain.state                    --resume
  wetcloth view rain_on_umbrella_cloth.json             play with it in a window: drag the cloth, change the weather
  wetcloth render flag_wind_100.json --out flag.mp4     a film; .png, .gif, .webm as well; needs no display
  wetcloth render hanging_towel.json --out towel.html   a page: orbit, play, scrub, plots
  wetcloth render dip_and_lift.json --out dip.png --times 0,3,6,9 --size 480x640    a strip of pictures
  wetcloth render hanging_towel.json --out towel.mp4 --compare    plain Bullet, dry and wet side by side
  wetcloth cost flag_wind_100.json                      what each effect of a scene takes, beside Bullet's step
  wetcloth accuracy --study wind --out accuracy         what accuracy costs in time: tables and plots
  wetcloth plot fall --out plots                        the wet and the dry fall as CSV, SVG and PNG
  wetcloth export curtain.json --format vtk --out curtain   for ParaView; for Blender, Houdini, ... see --help
  wetcloth validate *.json                              check scenes without running them
  wetcloth ccd queries.csv.gz --method exact            collision checks against exact answers
  wetcloth stability --group winds                      hard cases, and how near they come to what physics allows

Exit status: 0 done; 1 the run failed; 2 bad usage or bad input, with one line on standard error.)";

template <class Value>
std::vector<std::string> namesOf(const std::vector<std::pair<std::string, Value>>& pairs) {
  std::vector<std::string> names;
  for (const auto& [name, value] : pairs) names.push_back(name);
  return names;
}

/// Takes one of the words; the complaint suggests the nearest.
CLI::Validator oneOf(const std::string& option, const std::vector<std::string>& words) {
  const auto check = [option, words](const std::string& word) -> std::string {
    if (std::find(words.begin(), words.end(), word) != words.end()) return "";
    throw InputError("wetcloth: " + option + " = \"" + word + "\": " + didYouMean(word, words) + "must be one of " +
                     joined(words));
  };
  return CLI::Validator(check, joined(words), "one of");
}

void addRun(CLI::App& app, RunOptions& options, char** arguments) {
  CLI::App* const run = app.add_subcommand("run", "Run a scene");
  run->add_option("scene", options.scene, "Scene file (JSON, see docs/scenes.md)")->required();
  CLI::Option* const frames =
      run->add_option("--frames", options.frames, "Directory for pictures of the run, frame_0000.svg and so on");
  run->add_option("--frame-count", options.frameCount, "How many pictures, evenly spaced")
      ->capture_default_str()
      ->needs(frames);
  run->add_option("--json", options.json, "File for the results as JSON; - is standard output, with nothing else");
  run->add_option("--quality", options.quality,
                  "Substeps and iterations, instead of the scene's own: the cheapest that were measured within 10 % "
                  "(draft), 3 % (realtime) and 1 % (accurate), and the most accurate ones (reference); "
                  "see docs/accuracy.md")
      ->check(oneOf("--quality", namesOf(qualityNames())));
  run->add_option("--error-budget", options.errorBudget,
                  "The same for an error of your own, e.g. 1e-2, in all that the scene's effects were measured by");
  CLI::Option* const checkpoint = run->add_option(
      "--checkpoint", options.checkpoint, "File that is replaced now and then by the run as it is, for --resume");
  run->add_option("--every", options.every, "Steps of the scene from one checkpoint to the next")
      ->capture_default_str()
      ->needs(checkpoint);
  run->add_option("--resume", options.resume,
                  "Checkpoint to go on from; the run ends as if it had not been interrupted")
      ->excludes(frames);
  run->add_option("--duration", options.duration, "Simulated time [s], instead of the scene's own");
  run->add_option("--precision", options.precision, "Instead of the scene's own")
      ->check(oneOf("--precision", namesOf(precisionNames())));
  run->callback([&options, arguments] {
    if (options.frameCount < 1 || options.frameCount > 10000) {
      throw InputError("wetcloth: --frame-count = " + std::to_string(options.frameCount) + ": must be 1 to 10000");
    }
    if (options.errorBudget && !options.quality.empty()) {
      throw InputError("wetcloth: --error-budget and --quality: give one of the two");
    }
    if (options.every < 1) {
      throw InputError("wetcloth: --every = " + std::to_string(options.every) + ": must be at least 1");
    }
    runScene(options, arguments);
  });
}

void addRender(CLI::App& app, RenderOptions& options, char** arguments) {
  CLI::App* const render =
      app.add_subcommand("render", "Run a scene and draw pictures, a film or a page for a browser, without a display");
  render->add_option("scene", options.scene, "Scene file (JSON, see docs/scenes.md)")->required();
  render->add_option("--out", options.out, "File, which is replaced; its suffix chooses: " + joined(renderSuffixes()))
      ->required();
  render->add_option("--size", options.size,
                     "WIDTHxHEIGHT of the film or of each picture [pixels]; default 1280x720, for a .gif 640x360");
  render->add_option("--times", options.times, "Of a .png: when [s]; several give a strip; default is the end")
      ->delimiter(',');
  render->add_option("--fps", options.framesPerSecond,
                     "Of a film or page: pictures per second; default 30, for a .gif 25");
  render->add_option("--speed", options.speed, "Of a film: simulated seconds per second of film; 0.25 is slow motion")
      ->capture_default_str();
  render->add_option("--view", options.view, "X,Y,Z: what the camera looks along, instead of the scene's own direction")
      ->delimiter(',')
      ->expected(3);
  render->add_option("--orbit", options.orbit, "Turns the camera about the upright [degrees]")->capture_default_str();
  render->add_option("--field-of-view", options.fieldOfView, "Of the camera, vertical [degrees]");
  render->add_option("--colouring", options.colouring, "What the colours of a cloth show; all but fabric with a bar")
      ->check(oneOf("--colouring", colouringNames()))
      ->capture_default_str();
  render->add_flag("--compare", options.compare, "Plain Bullet, the dry scene and the wet one side by side");
  render->add_option("--duration", options.duration, "Simulated time [s], instead of the scene's own");
  render->add_option("--quality", options.quality, "Substeps and iterations, as for `wetcloth run`")
      ->check(oneOf("--quality", namesOf(qualityNames())));
  render->add_option("--precision", options.precision, "Instead of the scene's own")
      ->check(oneOf("--precision", namesOf(precisionNames())));
  render->add_option("--json", options.json, "File for what was drawn as JSON; - is standard output, and only that");
  render->callback([&options, arguments] { renderScene(options, arguments); });
}

void addFall(CLI::App& app, FallOptions& options, char** arguments) {
  CLI::App* const fall = app.add_subcommand("fall", "Let dry and wet cloth fall, beside plain Bullet");
  fall->add_option("--height", options.height, "Height of the fall [m]; default 19.62 (paper), 5.5 (physical)");
  fall->add_option("--mode", options.mode,
                   "paper: Table II, up to 84 times as heavy, drag linear in speed; physical: cotton, quadratic drag")
      ->check(oneOf("--mode", {"paper", "physical"}))
      ->capture_default_str();
  fall->add_option("--world", options.world, "Which of Bullet's worlds")
      ->check(oneOf("--world", namesOf(worldNames())))
      ->capture_default_str();
  fall->add_option("--precision", options.precision, "Of Bullet; default is that of this program")
      ->check(oneOf("--precision", namesOf(precisionNames())));
  fall->add_option("--json", options.json, "File for the results as JSON; - is standard output, with nothing else");
  fall->callback([&options, arguments] { compareFalls(options, arguments); });
}

void addCost(CLI::App& app, CostOptions& options, char** arguments) {
  CLI::App* const cost = app.add_subcommand("cost", "Measure what each effect takes, beside Bullet's own step");
  cost->add_option("scene", options.scene, "Scene file; default is a cloth of 64 x 64 nodes with every effect");
  cost->add_option("--steps", options.steps,
                   "Bullet's steps to measure in each world; default is what 8 s allow, at most 300");
  cost->add_option("--precision", options.precision, "Instead of the scene's own")
      ->check(oneOf("--precision", namesOf(precisionNames())));
  cost->add_option("--json", options.json, "File for the results as JSON; - is standard output, with nothing else");
  cost->callback([&options, arguments] {
    if (options.steps && (*options.steps < 1 || *options.steps > 100000)) {
      throw InputError("wetcloth: --steps = " + std::to_string(*options.steps) + ": must be 1 to 100000");
    }
    measureCost(options, arguments);
  });
}

void addAccuracy(CLI::App& app, accuracy::AccuracyOptions& options, char** arguments) {
  CLI::App* const command =
      app.add_subcommand("accuracy", "Measure how wrong each way to compute is, and what it takes");
  command
      ->add_option("--study", options.study,
                   "One of: absorption, diffusion, splitting, wind, cloth, mesh, collision, paper; precision: all of "
                   "them, quick, in float32 and float64; alone: all in this precision; all")
      ->check(oneOf("--study", accuracy::studyWords()))
      ->capture_default_str();
  command->add_flag("--quick", options.isQuick, "Fewer and coarser settings, each run once");
  command->add_option("--out", options.directory, "Directory for plots (CSV, with gnuplot SVG and PNG) and studies.md");
  command->add_option("--precision", options.precision, "Of Bullet; default is that of this program")
      ->check(oneOf("--precision", namesOf(precisionNames())));
  command->add_option("--json", options.json, "File for the results as JSON; - is standard output, with nothing else");
  command->callback([&options, arguments] { accuracy::studyAccuracy(options, arguments); });
}

void addPlot(CLI::App& app, PlotOptions& options) {
  CLI::App* const plot =
      app.add_subcommand("plot", "Plot the paper's numbers beside ours: CSV, with gnuplot SVG and PNG");
  plot->add_option(
          "name", options.name,
          "mass: of a node that soaks; fall: height against time; fps: frames per second; wicking: profile of a "
          "strip; springs: of the mesh; all")
      ->check(oneOf("NAME", plotWords()))
      ->capture_default_str();
  plot->add_option("--out", options.directory, "Directory for the files, made if it is not there")->required();
  plot->add_option("--json", options.json, "File for what was made as JSON; - is standard output, with nothing else");
  plot->callback([&options] { makePlots(options); });
}

void addExport(CLI::App& app, ExportOptions& options, char** arguments) {
  CLI::App* const command = app.add_subcommand("export", "Run a scene and write it for other programs");
  command->add_option("scene", options.scene, "Scene file (JSON, see docs/scenes.md)")->required();
  command->add_option("--format", options.format, exportFormatsExplained())
      ->check(oneOf("--format", exportFormats()))
      ->required();
  command->add_option("--out", options.out, "File, which is replaced, or folder, which must be new or empty")
      ->required();
  command->add_option("--fps", options.framesPerSecond, "Frames per simulated second")->capture_default_str();
  command->add_option("--duration", options.duration, "Simulated time [s], instead of the scene's own");
  command->add_option("--quality", options.quality, "Substeps and iterations, as for `wetcloth run`")
      ->check(oneOf("--quality", namesOf(qualityNames())));
  command->add_option("--precision", options.precision, "Instead of the scene's own")
      ->check(oneOf("--precision", namesOf(precisionNames())));
  command->add_option("--json", options.json, "File for what was written as JSON; - is standard output, and only that");
  command->callback([&options, arguments] { exportScene(options, arguments); });
}

void addView(CLI::App& app, viewer::ViewOptions& options, char** arguments) {
  CLI::App* const view = app.add_subcommand("view", "Play with a scene in a window");
  view->add_option("scene", options.scene, "Scene file (JSON, see docs/scenes.md)")->required();
  view->add_option("--size", options.size, "Of the window, WIDTHxHEIGHT [pixels]")->capture_default_str();
  view->add_flag("--paused", options.paused, "Begin paused");
  view->add_flag("--compare", options.compare, "Begin with plain Bullet beside the wet cloth");
  view->add_option("--quality", options.quality,
                   "Substeps and iterations, as for `wetcloth run`; the window changes both")
      ->check(oneOf("--quality", namesOf(qualityNames())));
  view->add_option("--precision", options.precision, "Instead of the scene's own")
      ->check(oneOf("--precision", namesOf(precisionNames())));
  view->add_option("--frames", options.frames, "Close the window after so many pictures, one step of the scene each");
  view->add_option("--screenshot", options.screenshot, "File for the window's last picture, .png");
  view->add_option("--json", options.json, "File for how it was left, as JSON; - is standard output");
  view->callback([&options, arguments] { viewer::viewScene(options, arguments); });
}

void addValidate(CLI::App& app, std::vector<std::string>& files) {
  CLI::App* const validate = app.add_subcommand("validate", "Check scenes without running them");
  validate->add_option("scenes", files, "Scene files")->required();
  validate->callback([&files] { validateScenes(files); });
}

void addCcd(CLI::App& app, CcdOptions& options, char** arguments) {
  CLI::App* const ccd = app.add_subcommand("ccd", "Count and time what a collision check gets wrong");
  std::vector<std::string> methods;
  std::string guarantees;
  for (const CcdMethodInfo& method : ccdMethods()) {
    methods.push_back(method.name);
    guarantees += (guarantees.empty() ? "" : ". ") + method.name + ": " + method.guarantee;
  }
  ccd->add_option("queries", options.file,
                  "Queries with their exact answers, as CSV (or that in gzip): id, scene, type (vf or ee), truth (1 or "
                  "0), x, y, z of the four points at the start and at the end")
      ->required();
  ccd->add_option("--method", options.method, guarantees)->check(oneOf("--method", methods))->capture_default_str();
  ccd->add_option("--tolerance", options.tolerance,
                  "fast, conservative, exact: width in time below which a contact is not looked for more closely; "
                  "textbook, newton: how far outside still counts; bullet has none. Default 1e-6");
  ccd->add_option("--passes", options.passes, "Everything is timed so often, and the median counts")
      ->capture_default_str();
  ccd->add_option("--precision", options.precision, "Of Bullet; default is that of this program")
      ->check(oneOf("--precision", namesOf(precisionNames())));
  ccd->add_option("--json", options.json, "File for the results as JSON; - is standard output, with nothing else");
  ccd->add_flag("--disagreements", options.disagreements, "Name the queries that are answered wrongly");
  ccd->callback([&options, arguments] { checkQueries(options, arguments); });
}

void addStability(CLI::App& app, stability::StabilityOptions& options, char** arguments) {
  CLI::App* const command =
      app.add_subcommand("stability", "Try hard cases, each long enough to blow up, against the bounds of physics");
  command->add_option("--case", options.name, "One of them; default is all of docs/stability.md")
      ->check(oneOf("--case", stability::caseNames()));
  command->add_option("--group", options.group, "One group of them")->check(oneOf("--group", stability::groupNames()));
  command->add_option("--world", options.world, "Bullet's world; none: the cases that need no world")
      ->check(oneOf("--world", namesOf(stability::stabilityWorlds())));
  command->add_option("--step", options.step,
                      "One step [s], 0.01 or 1/100, instead of 1/1000, 1/240, 1/60, 1/30, 1/10");
  command->add_option("--precision", options.precision, "Of Bullet; default is that of this program")
      ->check(oneOf("--precision", namesOf(precisionNames())));
  command->add_flag("--quick", options.isQuick, "Only the steps 1/240 s and 1/30 s, and a minute of laundry");
  command->add_option("--json", options.json, "File for the results as JSON; - is standard output, with nothing else");
  command->add_option(
      "--markdown", options.markdown,
      "File in which the table is written between the lines <!-- stability PRECISION --> and <!-- end of "
      "stability PRECISION -->");
  command->callback([&options, arguments] { stability::tryHardCases(options, arguments); });
}

/// CLI11 calls an unknown subcommand an extra argument.
void requireKnownCommand(const CLI::App& app, int count, char** arguments) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  if (count < 2) throw InputError("wetcloth: needs a command: " + joined(names) + "; see wetcloth --help");
  const std::string word = arguments[1];
  if (word[0] == '-' || std::find(names.begin(), names.end(), word) != names.end()) return;
  throw InputError("wetcloth: unknown command \"" + word + "\"; " + didYouMean(word, names) + "must be one of " +
                   joined(names));
}

/// CLI11 names what it does not know, but not what was meant.
void requireKnownOptions(const CLI::App& command, int count, char** arguments) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (int i = 2; i < count; ++i) {
    const std::string word = std::string(arguments[i]).substr(0, std::string(arguments[i]).find('='));
    if (word == "--") return;
    if (word.rfind("--", 0) != 0 || std::find(names.begin(), names.end(), word) != names.end()) continue;
    throw InputError("wetcloth: unknown option \"" + word + "\"; " + didYouMean(word, names) + "must be one of " +
                     joined(names));
  }
}

}  // namespace

int runCommandLine(int count, char** arguments) {
  CLI::App app("Runs scenes with cloth that gets wet, in Bullet, and compares them with Bullet as it is.", "wetcloth");
  app.footer(examples);
  app.set_version_flag("--version", "wetcloth " WETCLOTH_VERSION_STRING);
  app.require_subcommand(1);
  RunOptions run;
  FallOptions fall;
  CostOptions cost;
  viewer::ViewOptions view;
  CcdOptions ccd;
  stability::StabilityOptions hardCases;
  PlotOptions plot;
  accuracy::AccuracyOptions studied;
  ExportOptions exported;
  RenderOptions render;
  std::vector<std::string> files;
  addRun(app, run, arguments);
  addRender(app, render, arguments);
  addFall(app, fall, arguments);
  addCost(app, cost, arguments);
  addAccuracy(app, studied, arguments);
  addPlot(app, plot);
  addExport(app, exported, arguments);
  addView(app, view, arguments);
  addValidate(app, files);
  addCcd(app, ccd, arguments);
  addStability(app, hardCases, arguments);
  try {
    requireKnownCommand(app, count, arguments);
    if (arguments[1][0] != '-') requireKnownOptions(*app.get_subcommand(arguments[1]), count, arguments);
    app.parse(count, arguments);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    throw InputError("wetcloth: " + onOneLine(error.what()));
  }
  return 0;
}

}  // namespace command
