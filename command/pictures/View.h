// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

namespace pictures {

/// A pinhole camera.
struct View {
  Vector3 eye{};     ///< [m]
  Vector3 target{};  ///< looked at [m]
  Vector3 up{0, 1, 0};
  float fieldOfView = 30;  ///< vertical [degrees]
};

/// Looks along the scenery's direction, from as near as all that moves or stands there is in the picture in every
/// one of the frames.
/// @param aspect  width over height of the picture, > 0
View fitView(const Scenery& scenery, const std::vector<Frame>& frames, float aspect);

}  // namespace pictures
