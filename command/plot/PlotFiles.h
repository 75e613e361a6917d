// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/StagedOutput.h"
#include "command/plot/Plot.h"

#include <filesystem>
#include <string>

namespace command {

/// Writes plots into a directory, in which none is ever seen half-written.
class PlotFiles {
 public:
  /// Makes the directory. Throws InputError when it cannot be made or written to.
  explicit PlotFiles(const std::string& directory);

  /// NAME.csv and, where gnuplot is, NAME.svg and NAME.png. Throws RunError when they cannot be written or gnuplot
  /// fails; the table, if it could be written, stays.
  void write(const Plot& plot);

  /// Whether gnuplot was there for all plots so far.
  bool hasPictures() const { return m_hasPictures; }

 private:
  StagedOutput staged(const std::string& name) const;
  /// What gnuplot has drawn; it may say that all is well and have drawn nothing.
  void publish(StagedOutput& picture, const std::string& name) const;

  std::filesystem::path m_directory;
  bool m_hasPictures = true;
};

}  // namespace command
