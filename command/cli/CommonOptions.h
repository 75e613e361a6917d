// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Precision.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace command {

/// Takes one of the words; the complaint suggests the nearest.
/// @param option  "--mode"
CLI::Validator oneOf(const std::string& option, const std::vector<std::string>& words);

/// --json. @param what  stands in the file
void addJson(CLI::App& app, std::string& target, const std::string& what = "the results");

/// --precision, empty unless it is given.
void addPrecision(CLI::App& app, std::string& precision,
                  const std::string& explanation = "Of Bullet; default is that of this program");

/// What --precision says; where it was not given, this program's own.
PrecisionWish wishOf(const std::string& precision);

}  // namespace command
