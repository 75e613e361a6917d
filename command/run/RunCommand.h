// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/SceneOptions.h"

#include <optional>
#include <string>

namespace command {

struct RunOptions : SceneOptions {
  std::string frames;  ///< directory; empty: no pictures
  int frameCount = 12;
  std::optional<double> errorBudget;  ///< none: as the scene or its quality says
  std::string json;
  std::string checkpoint;  ///< file; empty: none
  int every = 100;         ///< steps of the scene from one checkpoint to the next
  std::string resume;      ///< file; empty: from the start
};

/// `wetcloth run`. @param arguments of the program, for its sibling of the other precision
void runScene(const RunOptions& options, char** arguments);

}  // namespace command
