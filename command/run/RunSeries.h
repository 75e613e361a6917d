// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/SceneWorld.h"

#include "command/pictures/FrameSequence.h"

#include <vector>

namespace command {

/// What a scene's cloths come to at one moment, one number for each of runSeries(). The speeds and stretches are
/// taken from the frame of this moment.
std::vector<double> measureRun(const SceneWorld& world, const pictures::Frame& frame);

/// The names and units of these numbers, without values.
std::vector<pictures::Series> runSeries();

}  // namespace command
