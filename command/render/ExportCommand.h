// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/SceneOptions.h"

#include <string>
#include <vector>

namespace command {

struct ExportOptions : SceneOptions {
  std::string format;
  std::string out;  ///< folder or file, as the format has it
  double framesPerSecond = 30;
  std::string json;
};

/// The words for --format.
std::vector<std::string> exportFormats();
/// What each of them is, on one line.
std::string exportFormatsExplained();

/// `wetcloth export`. @param arguments of the program, for its sibling of the other precision
void exportScene(const ExportOptions& options, char** arguments);

}  // namespace command
