// SPDX-License-Identifier: Zlib
#include "command/plot/PlotCommand.h"

#include "command/cli/CommonOptions.h"
#include "command/cli/JsonOutput.h"
#include "command/cli/Progress.h"
#include "command/plot/PlotFiles.h"
#include "command/plot/Plots.h"

#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace command {
namespace {

struct PlotOptions {
  std::string name = "all";
  std::string directory;
  std::string json;
};

std::vector<Plot> plotsOf(const std::string& name, MakePlots make) {
  Progress progress("plotting " + name);
  return make([&](double fraction) { progress.update(fraction); });
}

nlohmann::ordered_json jsonOf(const Plot& plot, const PlotOptions& options, bool hasPictures) {
  nlohmann::ordered_json series = nlohmann::ordered_json::array();
  for (const PlotSeries& one : plot.series) {
    if (!one.x.empty()) series.push_back({{"name", one.name}, {"points", one.x.size()}});
  }
  nlohmann::ordered_json files = {options.directory + "/" + plot.name + ".csv"};
  for (const char* const suffix : {".svg", ".png"}) {
    if (hasPictures) files.push_back(options.directory + "/" + plot.name + suffix);
  }
  return {{"name", plot.name}, {"title", plot.title}, {"x", plot.xColumn},
          {"y", plot.yColumn}, {"series", series},    {"files", files}};
}

/// What it takes for a name: those of plotNames() and "all".
std::vector<std::string> plotWords() {
  std::vector<std::string> words;
  for (const auto& [name, make] : plotNames()) words.push_back(name);
  words.emplace_back("all");
  return words;
}

void makePlots(const PlotOptions& options) {
  JsonOutput output(options.json);
  PlotFiles files(options.directory);
  nlohmann::ordered_json plots = nlohmann::ordered_json::array();
  for (const auto& [name, make] : plotNames()) {
    if (options.name != "all" && options.name != name) continue;
    for (const Plot& plot : plotsOf(name, make)) {
      files.write(plot);
      plots.push_back(jsonOf(plot, options, files.hasPictures()));
      if (output.ownsStandardOutput()) continue;
      std::printf("%s/%s.csv%s\n", options.directory.c_str(), plot.name.c_str(),
                  files.hasPictures() ? ", .svg, .png" : "");
    }
  }
  output.write({{"precision", nameOf(ownPrecision)}, {"pictures", files.hasPictures()}, {"plots", plots}});
  if (!files.hasPictures()) {
    std::cerr << "wetcloth: no gnuplot, so no pictures, only tables (Debian: apt install gnuplot-nox)\n";
  }
}

}  // namespace

Command addPlotCommand(CLI::App& line) {
  CLI::App* const app =
      line.add_subcommand("plot", "Plot the paper's numbers beside ours: CSV, with gnuplot SVG and PNG");
  const auto options = std::make_shared<PlotOptions>();
  app->add_option(
         "name", options->name,
         "mass: of a node that soaks; fall: height against time; fps: frames per second; wicking: profile of a "
         "strip; springs: of the mesh; all")
      ->check(oneOf("NAME", plotWords()))
      ->capture_default_str();
  app->add_option("--out", options->directory, "Directory for the files, made if it is not there")->required();
  addJson(*app, options->json, "what was made");
  return {app, [options] { makePlots(*options); }};
}

}  // namespace command
