// SPDX-License-Identifier: Zlib
#include "command/plot/PlotFiles.h"

#include "command/cli/Errors.h"
#include "command/plot/Gnuplot.h"

#include <fstream>
#include <random>
#include <system_error>

namespace command {
namespace {

namespace fs = std::filesystem;

RunError notWritten(const fs::path& path) {
  return RunError("wetcloth: --out = \"" + path.string() + "\": could not be written");
}

}  // namespace

PlotFiles::PlotFiles(const std::string& directory)
    : m_directory(directory), m_aside(m_directory / (".wetcloth-plot-" + std::to_string(std::random_device()()))) {
  std::error_code failed;
  fs::create_directories(m_directory, failed);
  if (fs::create_directory(m_aside, failed)) return;
  throw InputError("wetcloth: --out = \"" + directory + "\": must be a directory that can be written to");
}

PlotFiles::~PlotFiles() {
  std::error_code ignored;
  fs::remove_all(m_aside, ignored);
}

void PlotFiles::write(const Plot& plot) {
  const std::string csv = plot.name + ".csv";
  const std::string svg = plot.name + ".svg";
  const std::string png = plot.name + ".png";
  writeAside(csv, csvOf(plot));
  publish(csv);
  if (!m_hasPictures) return;
  writeAside("script.gnuplot", gnuplotScript(plot, (m_directory / csv).string(), aside(svg), aside(png)));
  m_hasPictures = runGnuplot(aside("script.gnuplot"));
  if (!m_hasPictures) return;
  publish(svg);
  publish(png);
}

void PlotFiles::writeAside(const std::string& name, const std::string& text) const {
  std::ofstream file(m_aside / name, std::ios::binary | std::ios::trunc);
  file << text << std::flush;
  if (!file) throw notWritten(m_directory / name);
}

void PlotFiles::publish(const std::string& name) const {
  std::error_code failed;
  fs::rename(m_aside / name, m_directory / name, failed);
  if (failed) throw notWritten(m_directory / name);
}

}  // namespace command
