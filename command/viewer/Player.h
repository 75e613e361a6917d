// SPDX-License-Identifier: Zlib
#pragma once

#include "command/viewer/LiveScene.h"

#include <optional>
#include <string>

namespace viewer {

struct PlayerOptions {
  int width = 1280;  ///< of the window [pixels]
  int height = 800;
  std::optional<int> frames;  ///< none: until the window is closed
  std::string lastPicture;    ///< file for it as PNG; empty: none
};

/// What somebody did in the window, and how fast it was.
struct PlayerReport {
  int frames = 0;              ///< pictures that were shown
  double framesPerSecond = 0;  ///< of them
  int drags = 0;               ///< how often a cloth was held
  std::string colouring;       ///< of the last picture
  bool slowMotion = false;
};

/// Throws InputError that says what to install when this program was built without a window.
void requirePlayer();
/// Shows the scene in a window until it is closed. Throws RunError when there is no display, or no OpenGL 3.3.
PlayerReport play(LiveScene& live, const PlayerOptions& options);

}  // namespace viewer
