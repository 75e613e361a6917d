// SPDX-License-Identifier: Zlib
#include "command/fit/FitCommand.h"

#include "command/fit/FitReport.h"
#include "command/fit/FitWarnings.h"

#include "command/cli/CommonOptions.h"
#include "command/cli/DistinctFiles.h"
#include "command/cli/Errors.h"
#include "command/cli/JsonOutput.h"
#include "command/plot/PlotFiles.h"

#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace fit {
namespace {

struct FitOptions {
  std::string file;
  std::string of;
  std::string fabric = "cotton";
  std::string directory;  ///< of the plots; empty: none
  std::string json;
};

std::vector<std::string> fabricNames() {
  std::vector<std::string> names;
  for (const wetcloth::Fabric& fabric : wetcloth::Fabric::presets()) names.push_back(fabric.name);
  return names;
}

void writePlots(command::PlotFiles& files, const Task& task, const Fit& fit) {
  for (const command::Plot& plot : plotsOf(task, fit)) files.write(plot);
  if (files.hasPictures()) return;
  std::cerr << "wetcloth: no gnuplot, so no pictures, only tables (Debian: apt install gnuplot-nox)\n";
}

/// Where the model fails for readings that cloth cannot have, these are why. What fails is of this file.
Fit fitOf(const std::string& file, const Task& task) {
  try {
    return fitLeastSquares(task.unknowns, task.predict, task.readings, task.roughness);
  } catch (const command::RunError& error) {
    const std::vector<std::string> doubts = doubtsOf(task);
    throw command::RunError(file + ": " + error.what() + (doubts.empty() ? "" : "; " + doubts.front()));
  } catch (const command::InputError& error) {
    throw command::InputError(file + ": " + error.what());
  }
}

void requireConverged(const std::string& file, const Fit& fit) {
  if (fit.hasConverged) return;
  throw command::RunError(file + ": the fit did not converge in " + std::to_string(fitSteps) +
                          " steps, so do not use its values: add readings where the curve bends, leave out those that "
                          "are not of it; --out DIR draws them");
}

void fitToFile(const FitOptions& options) {
  command::requireDistinctFiles({{"the measurements", options.file}, {"--json", options.json}});
  command::JsonOutput output(options.json);
  const command::MeasuredTable table(options.file);
  const Task task = command::valueOf(taskNames(), options.of)(table, wetcloth::Fabric::byName(options.fabric));
  std::optional<command::PlotFiles> plots;  // complains before the fit, which may take its time
  if (!options.directory.empty()) plots.emplace(options.directory);
  const Fit fit = fitOf(options.file, task);
  if (!output.ownsStandardOutput()) std::fputs(textOf(task, fit).c_str(), stdout);
  if (plots) writePlots(*plots, task, fit);
  nlohmann::ordered_json json = jsonOf(task, fit);
  json["file"] = options.file;
  output.write(json);
  requireConverged(options.file, fit);
}

}  // namespace

command::Command addFitCommand(CLI::App& line) {
  CLI::App* const app =
      line.add_subcommand("fit", "Fit the model to your own measurements: a cloth for a scene, with uncertainties");
  const auto options = std::make_shared<FitOptions>();
  app->add_option("DATA.csv", options->file, "Measurements: a line of column names, then a row for each reading")
      ->required();
  app->add_option("--of", options->of,
                  "absorption: time_s, water_kg_kg; wicking: time_s, height_m; drying: time_s, water_kg_kg; stretch: "
                  "load_n_m, strain, optionally saturation. A column water_sd_kg_kg, height_sd_m or strain_sd has the "
                  "standard deviations")
      ->check(command::oneOf("--of", command::namesOf(taskNames())))
      ->required();
  app->add_option("--fabric", options->fabric, "Preset of what is not measured")
      ->check(command::oneOf("--fabric", fabricNames()))
      ->capture_default_str();
  app->add_option("--out", options->directory, "Directory for plots of the fit and its residuals");
  command::addJson(*app, options->json);
  return {app, [options] { fitToFile(*options); }};
}

}  // namespace fit
