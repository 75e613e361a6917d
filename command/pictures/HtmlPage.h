// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <string>

namespace pictures {

/// Writes the run as one page that needs nothing else: a browser with WebGL 2 opens it from disk. It shows the cloths
/// from all sides, plays, and plots the series.
/// Throws std::runtime_error that says why it could not be written.
void writeHtml(const FrameSequence& sequence, const std::string& path);

}  // namespace pictures
