// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <functional>

namespace command {

/// The same scene without these effects, as if its file did not name them: a cloth of the deformable world that loses
/// `hooke_springs` gets Bullet's own springs.
Scene leaveOut(const Scene& scene, const std::function<bool(const EffectScene&)>& isUnwanted);

}  // namespace command
