// SPDX-License-Identifier: Zlib
#pragma once

#include "command/accuracy/Study.h"

#include <nlohmann/json.hpp>

#include <string>

namespace accuracy {

/// An error that is not finite is null, and has "blows_up".
nlohmann::ordered_json jsonOf(const Study& study);

/// The same for people, as a table. @param width  of the column of settings is fitted to the study
std::string textOf(const Study& study);

/// As a section of a page in Markdown, with the plot of this file's name.
std::string markdownOf(const Study& study, const std::string& picture);

}  // namespace accuracy
