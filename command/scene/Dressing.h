// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <LinearMath/btVector3.h>

#include <vector>

namespace command {

/// Where the nodes of each garment are when a scene begins [m]: before that, while all colliders are where they are at
/// time 0, its seams are drawn together and it settles, dry, slowly and on our own solver with its guard. None of a
/// cloth that is not sewn. Found once for a scene and its copies.
/// Throws RunError when a cloth does not stay finite.
const std::vector<std::vector<btVector3>>& dressedPlaces(const Scene& scene);

}  // namespace command
