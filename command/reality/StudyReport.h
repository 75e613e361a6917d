// SPDX-License-Identifier: Zlib
#pragma once

#include "command/plot/Plot.h"
#include "command/reality/Study.h"

#include <nlohmann/json.hpp>

#include <string>

namespace reality {

/// For programs: every reading beside the model's.
nlohmann::ordered_json jsonOf(const Study& study);
/// The same for people.
std::string textOf(const Study& study);
/// A section of a page in Markdown, with the plot of this file's name; without the single readings.
std::string markdownOf(const Study& study, const std::string& picture);
/// "The prediction is within ...": what the errors come to, in one sentence.
std::string verdictOn(const Study& study);

/// Readings as points. Over time: the model as a line, dashed where it predicts; else as points.
command::Plot plotOf(const Study& study);

}  // namespace reality
