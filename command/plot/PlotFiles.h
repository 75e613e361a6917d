// SPDX-License-Identifier: Zlib
#pragma once

#include "command/plot/Plot.h"

#include <filesystem>
#include <string>

namespace command {

/// Writes plots into a directory. Files are made in a directory aside and then renamed, so that none is ever seen
/// half-written; what is aside goes with the object.
class PlotFiles {
 public:
  /// Makes the directory. Throws InputError when it cannot be made or written to.
  explicit PlotFiles(const std::string& directory);
  ~PlotFiles();
  PlotFiles(const PlotFiles&) = delete;
  PlotFiles& operator=(const PlotFiles&) = delete;

  /// NAME.csv and, where gnuplot is, NAME.svg and NAME.png. Throws RunError when they cannot be written or gnuplot
  /// fails; the table, if it could be written, stays.
  void write(const Plot& plot);

  /// Whether gnuplot was there for all plots so far.
  bool hasPictures() const { return m_hasPictures; }

 private:
  std::string aside(const std::string& name) const { return (m_aside / name).string(); }
  void writeAside(const std::string& name, const std::string& text) const;
  void publish(const std::string& name) const;

  std::filesystem::path m_directory;
  std::filesystem::path m_aside;
  bool m_hasPictures = true;
};

}  // namespace command
