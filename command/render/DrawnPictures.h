// SPDX-License-Identifier: Zlib
#pragma once

#include "command/render/RenderJob.h"

namespace command {

// All throw what the classes of pictures throw that they are made with: pictures::Unavailable when something is not
// installed, std::runtime_error when it fails.

/// Whether there is all that is needed for pictures of this size.
void requirePng(int width, int height);
void requireFilm(int width, int height);

/// One picture, or a strip of one for each frame, as PNG.
RenderResult drawPng(const RenderJob& job);
/// A film of all frames; job.path ends in .mp4, .webm or .gif.
RenderResult drawFilm(const RenderJob& job);

}  // namespace command
