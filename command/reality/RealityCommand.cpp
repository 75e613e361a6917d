// SPDX-License-Identifier: Zlib
#include "command/reality/RealityCommand.h"

#include "command/reality/Studies.h"
#include "command/reality/StudyReport.h"

#include "command/cli/CommonOptions.h"
#include "command/cli/Errors.h"
#include "command/cli/JsonOutput.h"
#include "command/cli/Progress.h"
#include "command/plot/PlotFiles.h"

#include <cstdio>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace reality {
namespace {

struct RealityOptions {
  std::string study = "all";
  std::string directory;  ///< of the plots and the page; empty: none
  std::string precision;  ///< empty: that of this program
  std::string json;
};

Study studyOf(const StudyEntry& entry) {
  command::Progress progress("comparing " + entry.name);
  Plan plan = entry.plan(command::measuredFile(entry.data));
  plan.data = entry.data;
  return carryOut(plan, [&](double fraction) { progress.update(fraction); });
}

/// Plots, and a page with the studies.
class RealityFiles {
 public:
  explicit RealityFiles(const std::string& directory) : m_directory(directory) {
    if (!directory.empty()) m_plots = std::make_unique<command::PlotFiles>(directory);
  }
  void add(const Study& study) {
    if (!m_plots) return;
    m_plots->write(plotOf(study));
    m_page += markdownOf(study, m_plots->hasPictures() ? study.plan.name + ".svg" : "");
  }
  void finish() const {
    if (!m_plots) return;
    std::ofstream file(m_directory + "/studies.md", std::ios::binary);
    file << m_page << std::flush;
    if (!file) throw command::RunError("wetcloth: --out = \"" + m_directory + "\": studies.md could not be written");
    if (m_plots->hasPictures()) return;
    std::cerr << "wetcloth: no gnuplot, so no pictures, only tables (Debian: apt install gnuplot-nox)\n";
  }

 private:
  std::string m_directory;
  std::unique_ptr<command::PlotFiles> m_plots;
  std::string m_page;
};

std::vector<std::string> realityWords() {
  std::vector<std::string> words;
  for (const StudyEntry& entry : studyEntries()) words.push_back(entry.name);
  words.emplace_back("all");
  return words;
}

void compareWithReality(const RealityOptions& options) {
  command::JsonOutput output(options.json);
  RealityFiles files(options.directory);
  nlohmann::ordered_json studies = nlohmann::ordered_json::array();
  for (const StudyEntry& entry : studyEntries()) {
    if (options.study != "all" && options.study != entry.name) continue;
    const Study study = studyOf(entry);
    files.add(study);
    studies.push_back(jsonOf(study));
    if (!output.ownsStandardOutput()) std::printf("%s\n", textOf(study).c_str());
  }
  files.finish();
  output.write({{"precision", command::nameOf(command::ownPrecision)}, {"studies", studies}});
}

}  // namespace

command::Command addRealityCommand(CLI::App& line) {
  CLI::App* const app =
      line.add_subcommand("reality", "Run the models beside what others have measured: errors, fitted and predicted");
  const auto options = std::make_shared<RealityOptions>();
  std::string names;
  for (const std::string& word : realityWords()) names += (names.empty() ? "One of: " : ", ") + word;
  app->add_option("--study", options->study, names)
      ->check(command::oneOf("--study", realityWords()))
      ->capture_default_str();
  app->add_option("--out", options->directory, "Directory for plots (CSV, with gnuplot SVG and PNG) and studies.md");
  command::addPrecision(*app, options->precision);
  command::addJson(*app, options->json);
  return {app, [options] { compareWithReality(*options); }, [options] { return command::wishOf(options->precision); }};
}

}  // namespace reality
