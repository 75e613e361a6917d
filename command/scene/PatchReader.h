// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/JsonCursor.h"

#include "bullet_wetcloth/bullet_wetcloth.h"

#include <string>
#include <utility>
#include <vector>

namespace command {

wetcloth::ClothPatch readPatch(JsonCursor cursor);
/// As scenes call them.
const std::vector<std::pair<std::string, wetcloth::ClothPatch::Edge>>& edgeNames();
/// The nodes of an edge, from the left or from below.
std::vector<int> nodesOfEdge(const wetcloth::ClothPatch& patch, wetcloth::ClothPatch::Edge edge);

}  // namespace command
