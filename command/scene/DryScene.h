// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

namespace command {

/// The same scene without water in its cloths: it begins dry, and effects that bring, move or take water are left out.
Scene dryScene(const Scene& scene);

}  // namespace command
