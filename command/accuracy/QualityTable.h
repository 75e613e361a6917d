// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/MeasuredFront.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace accuracy {

/// What each quality comes to, for each way to hold a cloth together, in a scene with absorption, diffusion and wind.
struct QualityRow {
  std::string quality;
  double allowedError = 0;
  std::string elasticity;
  command::SteppingChoice choice;
};

/// @param measured  as measuredJson() has it; empty when it lacks a study
std::vector<QualityRow> qualityRows(const nlohmann::json& measured);

nlohmann::ordered_json jsonOf(const std::vector<QualityRow>& rows);
/// A table, for people and for a page in Markdown.
std::string markdownOf(const std::vector<QualityRow>& rows);

}  // namespace accuracy
