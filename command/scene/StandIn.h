// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

namespace command {

/// The same scene with patches of a few nodes, as heavy and as far apart as those of the scene: what the library
/// refuses for another reason than the number of nodes, it refuses here, too. To ask it without building a large cloth.
Scene standIn(const Scene& scene);

}  // namespace command
