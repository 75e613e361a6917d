// SPDX-License-Identifier: Zlib
#pragma once

#include <string>
#include <vector>

namespace command {

struct PlotOptions {
  std::string name = "all";
  std::string directory;
  std::string json;
};

/// What `wetcloth plot` takes for a name: those of plotNames() and "all".
std::vector<std::string> plotWords();

/// `wetcloth plot`.
void makePlots(const PlotOptions& options);

}  // namespace command
