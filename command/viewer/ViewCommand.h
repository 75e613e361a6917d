// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/SceneOptions.h"

#include <optional>
#include <string>

namespace viewer {

struct ViewOptions : command::SceneOptions {
  std::string size = "1280x800";  ///< of the window [pixels]
  bool paused = false;
  bool compare = false;
  std::optional<int> frames;  ///< closes the window after so many pictures, one step each; none: when told to
  std::string screenshot;     ///< file for the last picture; empty: none
  std::string json;
};

/// `wetcloth view`. @param arguments of the program, for its sibling of the other precision
void viewScene(const ViewOptions& options, char** arguments);

}  // namespace viewer
