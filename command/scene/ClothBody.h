// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <memory>
#include <vector>

namespace command {

/// A cloth of a scene as Bullet has it, with its pins and what the scene says of friction, damping and collision; not
/// yet in a world. Throws std::invalid_argument when the library refuses the patch.
std::unique_ptr<btSoftBody> makeClothBody(const ClothScene& cloth, btSoftBodyWorldInfo& worldInfo);

/// Puts its nodes elsewhere, at rest; links stay as long as they want to be. @param places  one for each node [m]
void placeNodes(btSoftBody& body, const std::vector<btVector3>& places);

}  // namespace command
