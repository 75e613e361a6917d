// SPDX-License-Identifier: Zlib
#include "command/accuracy/AccuracyCommand.h"

#include "command/accuracy/MeasuredFile.h"
#include "command/accuracy/PrecisionStudy.h"
#include "command/accuracy/QualityTable.h"
#include "command/accuracy/Studies.h"
#include "command/accuracy/StudyPlot.h"
#include "command/accuracy/StudyReport.h"

#include "command/cli/CommonOptions.h"
#include "command/cli/Errors.h"
#include "command/cli/JsonOutput.h"
#include "command/cli/PrecisionProgram.h"
#include "command/cli/Progress.h"
#include "command/pictures/ChildProgram.h"
#include "command/plot/PlotFiles.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <random>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace accuracy {
namespace {

using Json = nlohmann::ordered_json;
using command::Precision;

struct AccuracyOptions {
  std::string study = "all";
  bool isQuick = false;
  std::string directory;  ///< of the plots and the page; empty: none
  std::string precision;  ///< empty: that of this program
  std::string json;
};

std::vector<Study> carryOutNamed(const std::string& name, CarryOutStudies carryOut, const Effort& effort) {
  command::Progress progress("studying " + name);
  return carryOut(effort, [&](double fraction) { progress.update(fraction); });
}

/// The quick studies of the other precision's program, or null when it is not there.
nlohmann::json quickStudiesOf(Precision precision) {
  const std::string program = command::programOf(precision);
  if (program.empty()) return nullptr;
  namespace fs = std::filesystem;
  const fs::path file = fs::temp_directory_path() / ("wetcloth-" + std::to_string(std::random_device()()) + ".json");
  nlohmann::json studies;
  {
    pictures::ChildProgram child({program, "accuracy", "--quick", "--study", "alone", "--json", file.string()});
    if (!child.finish()) throw command::RunError("wetcloth: " + program + ": " + child.complaint());
    studies = nlohmann::json::parse(std::ifstream(file)).at("studies");
  }
  std::error_code ignored;
  fs::remove(file, ignored);
  return studies;
}

nlohmann::json ownQuickStudies() {
  nlohmann::json studies = nlohmann::json::array();
  for (const auto& [name, carryOut] : studyNames()) {
    for (const Study& study : carryOutNamed(name, carryOut, {true})) studies.emplace_back(jsonOf(study));
  }
  return studies;
}

std::vector<Study> studyPrecision() {
  const bool isFloat32 = command::ownPrecision == Precision::float32;
  const nlohmann::json others = quickStudiesOf(isFloat32 ? Precision::float64 : Precision::float32);
  if (others.is_null()) {
    std::cerr << "wetcloth: no program of the other precision beside this one, so no study of precision\n";
    return {};
  }
  const nlohmann::json own = ownQuickStudies();
  return {isFloat32 ? comparePrecisions(own, others) : comparePrecisions(others, own)};
}

/// Plots and a page with all studies.
class StudyFiles {
 public:
  explicit StudyFiles(const std::string& directory) : m_directory(directory) {
    if (!directory.empty()) m_plots = std::make_unique<command::PlotFiles>(directory);
  }
  void add(const Study& study) {
    if (!m_plots) return;
    const bool isPlotted = study.measure.name != "precision";
    if (isPlotted) m_plots->write(plotOf(study));
    m_studies.push_back(study);
    m_page += markdownOf(study, isPlotted && m_plots->hasPictures() ? study.measure.name + ".svg" : "");
  }
  void finish() const {
    if (!m_plots) return;
    const nlohmann::ordered_json measured = measuredJson(m_studies);
    write("measured.json", measured.dump(1) + "\n");
    const std::string qualities = markdownOf(qualityRows(measured));
    write("studies.md", (qualities.empty() ? "" : "## Qualities\n\n" + qualities + "\n") + "## Studies (" +
                            command::nameOf(command::ownPrecision) + ")\n\n" + m_page);
    if (m_plots->hasPictures()) return;
    std::cerr << "wetcloth: no gnuplot, so no pictures, only tables (Debian: apt install gnuplot-nox)\n";
  }

 private:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream file(std::filesystem::path(m_directory) / name, std::ios::binary);
    file << text << std::flush;
    if (!file) throw command::RunError("wetcloth: --out = \"" + m_directory + "\": " + name + " could not be written");
  }

  std::string m_directory;
  std::unique_ptr<command::PlotFiles> m_plots;
  std::vector<Study> m_studies;
  std::string m_page;
};

/// What --study takes: the names of studyNames(), "precision", "alone" and "all".
std::vector<std::string> studyWords() {
  std::vector<std::string> words;
  for (const auto& [name, carryOut] : studyNames()) words.push_back(name);
  for (const char* const word : {"precision", "alone", "all"}) words.emplace_back(word);
  return words;
}

void studyAccuracy(const AccuracyOptions& options) {
  command::JsonOutput output(options.json);
  StudyFiles files(options.directory);
  Json studies = Json::array();
  std::vector<Study> all;
  const auto report = [&](const std::vector<Study>& more) {
    for (const Study& study : more) {
      all.push_back(study);
      files.add(study);
      studies.push_back(jsonOf(study));
      if (!output.ownsStandardOutput()) std::printf("%s\n", textOf(study).c_str());
    }
  };
  const bool isAll = options.study == "all" || options.study == "alone";
  for (const auto& [name, carryOut] : studyNames()) {
    if (isAll || options.study == name) report(carryOutNamed(name, carryOut, {options.isQuick}));
  }
  if (options.study == "all" || options.study == "precision") report(studyPrecision());
  files.finish();
  const std::vector<QualityRow> qualities = qualityRows(measuredJson(all));
  if (!output.ownsStandardOutput()) std::fputs(markdownOf(qualities).c_str(), stdout);
  output.write({{"precision", command::nameOf(command::ownPrecision)},
                {"quick", options.isQuick},
                {"studies", studies},
                {"qualities", jsonOf(qualities)}});
}

}  // namespace

command::Command addAccuracyCommand(CLI::App& line) {
  CLI::App* const app = line.add_subcommand("accuracy", "Measure how wrong each way to compute is, and what it takes");
  const auto options = std::make_shared<AccuracyOptions>();
  app->add_option("--study", options->study,
                  "One of: absorption, diffusion, splitting, wind, pace, cloth, mesh, collision, guard, paper; "
                  "precision: all of "
                  "them, quick, in float32 and float64; alone: all in this precision; all")
      ->check(command::oneOf("--study", studyWords()))
      ->capture_default_str();
  app->add_flag("--quick", options->isQuick, "Fewer and coarser settings, each run once");
  app->add_option("--out", options->directory, "Directory for plots (CSV, with gnuplot SVG and PNG) and studies.md");
  command::addPrecision(*app, options->precision);
  command::addJson(*app, options->json);
  return {app, [options] { studyAccuracy(*options); }, [options] { return command::wishOf(options->precision); }};
}

}  // namespace accuracy
