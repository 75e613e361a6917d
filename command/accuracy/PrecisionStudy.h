// SPDX-License-Identifier: Zlib
#pragma once

#include "command/accuracy/Study.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace accuracy {

/// The same studies in float32 and in float64: of each the most accurate setting in float32, and the same in float64.
/// @param float32, float64  as jsonOf() has them, of the same quick studies
Study comparePrecisions(const nlohmann::json& float32, const nlohmann::json& float64);

}  // namespace accuracy
