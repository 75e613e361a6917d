// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/SceneWorld.h"

#include "command/pictures/FrameSequence.h"

#include <vector>

namespace command {

/// Runs a scene from its start to its end and keeps what pictures and files need, with progress on standard error.
/// A frame that falls between two steps is mixed of both. Series that are zero throughout, or the same as another, are
/// left out.
///
/// Throws InputError when the library refuses the scene, or when so many frames would not fit into memory (2 GB);
/// RunError when the run becomes non-finite.
/// @param times  of the frames [s], ascending, from 0 to the scene's duration
pictures::FrameSequence sampleRun(const Scene& scene, const std::vector<double>& times,
                                  SceneWorld::Kind kind = SceneWorld::Kind::wet);

/// Frames that are 1 / framesPerSecond apart, the first at the start.
/// @param framesPerSecond  of simulated time, > 0
pictures::FrameSequence sampleRun(const Scene& scene, double framesPerSecond);

}  // namespace command
