// SPDX-License-Identifier: Zlib
#include "command/plot/PlotFiles.h"

#include "command/cli/Errors.h"
#include "command/plot/Gnuplot.h"

#include <fstream>
#include <system_error>

namespace command {
namespace {

namespace fs = std::filesystem;

std::string optionFor(const fs::path& path) { return "wetcloth: --out = \"" + path.string() + "\""; }

void writeText(const StagedOutput& output, const std::string& option, const std::string& text) {
  std::ofstream file(output.path(), std::ios::binary | std::ios::trunc);
  file << text << std::flush;
  if (!file) throw RunError(option + ": could not be written");
}

}  // namespace

PlotFiles::PlotFiles(const std::string& directory) : m_directory(directory) {
  std::error_code failed;
  fs::create_directories(m_directory, failed);
  try {
    staged("plot");
  } catch (const InputError&) {
    throw InputError(optionFor(directory) + ": must be a directory that can be written to");
  }
}

void PlotFiles::write(const Plot& plot) {
  const fs::path csv = m_directory / (plot.name + ".csv");
  StagedOutput table = staged(plot.name + ".csv");
  writeText(table, optionFor(csv), csvOf(plot));
  table.commit();
  if (!m_hasPictures) return;
  StagedOutput svg = staged(plot.name + ".svg");
  StagedOutput png = staged(plot.name + ".png");
  const StagedOutput script = staged("script.gnuplot");  // stays nowhere
  writeText(script, optionFor(m_directory), gnuplotScript(plot, csv.string(), svg.path(), png.path()));
  m_hasPictures = runGnuplot(script.path());
  if (!m_hasPictures) return;
  svg.commit();
  png.commit();
}

StagedOutput PlotFiles::staged(const std::string& name) const {
  const fs::path path = m_directory / name;
  return {optionFor(path), path.string(), StagedOutput::Kind::file};
}

}  // namespace command
