// SPDX-License-Identifier: Zlib
#pragma once

#include "command/run/FrameShot.h"
#include "command/scene/Camera.h"
#include "command/scene/Scene.h"

#include <string>
#include <vector>

namespace command {

/// The camera of a scene, fitted to everything that is seen in any of the shots.
Camera fitCamera(const Scene& scene, const std::vector<FrameShot>& shots);

/// One moment of a run as a picture that any browser opens: cloths lit from both sides in their wet colours,
/// colliders, and shadows on the ground, painted from the farthest to the nearest.
/// @param world the scene's world, for its faces and pins
std::string svgFrame(const SceneWorld& world, const Camera& camera, const FrameShot& shot);

}  // namespace command
