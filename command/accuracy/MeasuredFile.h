// SPDX-License-Identifier: Zlib
#pragma once

#include "command/accuracy/Study.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace accuracy {

/// What the command keeps of its studies as command/scene/measured.json, to choose a scene's stepping by: all points
/// of the studies of absorption, diffusion, quadratic wind and the cloth that a scene can be stepped by.
nlohmann::ordered_json measuredJson(const std::vector<Study>& studies);

}  // namespace accuracy
