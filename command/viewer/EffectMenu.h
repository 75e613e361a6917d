// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <string>
#include <vector>

namespace viewer {

/// An effect that a viewer offers for a tick box.
struct OfferedEffect {
  std::string key;               ///< as scenes spell it
  command::AddEffect byDefault;  ///< with the library's defaults; empty: only a scene can say where or with what
};

/// All effects, in the order in which scenes add them. @param scene whose gravity tells where rain falls to
std::vector<OfferedEffect> effectMenu(const command::Scene& scene);

}  // namespace viewer
