// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/Colouring.h"
#include "command/pictures/FrameSequence.h"

#include <string>
#include <vector>

namespace command {

/// A run to be compared with others in one picture.
struct Panel {
  std::string heading;  ///< empty: none
  pictures::FrameSequence sequence;
};

/// What is to be made of runs.
struct RenderJob {
  std::string path;            ///< where to write
  std::vector<Panel> panels;   ///< side by side; all have frames at the same times
  int width = 0;               ///< of a picture with all panels [pixels]
  int height = 0;              ///< [pixels]
  double framesPerSecond = 0;  ///< of a film
  pictures::Colouring colouring = pictures::Colouring::fabric;
};

/// What came of it.
struct RenderResult {
  int width = 0;   ///< of what was written [pixels]; 0: it has no size of its own
  int height = 0;  ///< [pixels]
  double secondsOfDrawing = 0;
  std::string renderer;  ///< empty: nothing was drawn
};

}  // namespace command
