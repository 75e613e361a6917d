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

RunError notWritten(const fs::path& path) { return RunError(optionFor(path) + ": could not be written"); }

void writeText(const StagedOutput& output, const fs::path& path, const std::string& text) {
  std::ofstream file(output.path(), std::ios::binary | std::ios::trunc);
  file << text << std::flush;
  if (!file) throw notWritten(path);
}

}  // namespace

PlotFiles::PlotFiles(const std::string& directory) : m_directory(directory) {
  std::error_code failed;
  fs::create_directories(m_directory, failed);
  try {
    staged("plot");
  } catch (const RunError&) {
    throw InputError(optionFor(directory) + ": must be a directory that can be written to");
  }
}

void PlotFiles::write(const Plot& plot) {
  const fs::path csv = m_directory / (plot.name + ".csv");
  StagedOutput table = staged(plot.name + ".csv");
  writeText(table, csv, csvOf(plot));
  table.commit();
  if (!m_hasPictures) return;
  StagedOutput svg = staged(plot.name + ".svg");
  StagedOutput png = staged(plot.name + ".png");
  const StagedOutput script = staged("script.gnuplot");  // stays nowhere
  writeText(script, m_directory, gnuplotScript(plot, csv.string(), svg.path(), png.path()));
  m_hasPictures = runGnuplot(script.path());
  if (!m_hasPictures) return;
  publish(svg, plot.name + ".svg");
  publish(png, plot.name + ".png");
}

StagedOutput PlotFiles::staged(const std::string& name) const {
  const fs::path path = m_directory / name;
  try {
    return {optionFor(path), path.string(), StagedOutput::Kind::file};
  } catch (const InputError&) {
    throw notWritten(path);
  }
}

void PlotFiles::publish(StagedOutput& picture, const std::string& name) const {
  std::error_code failed;
  const bool isEmpty = fs::file_size(picture.path(), failed) == 0;
  if (failed || isEmpty) throw notWritten(m_directory / name);
  picture.commit();
}

}  // namespace command
