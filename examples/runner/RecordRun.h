#pragma once

#include "Scene.h"

#include "../pictures/Recording.h"

namespace runner {

/// Runs a scene from its start to its end and keeps what pictures and files need, with progress on standard error.
/// Frames are 1 / framesPerSecond apart, the first at the start; one that falls between two steps is mixed of both.
/// Series that are zero throughout are left out.
///
/// Throws InputError when the library refuses the scene, or when so many frames would not fit into memory (2 GB);
/// RunError when the run becomes non-finite.
/// @param framesPerSecond  of simulated time, > 0
pictures::Recording recordRun(const Scene& scene, double framesPerSecond);

}  // namespace runner
