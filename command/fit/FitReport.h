// SPDX-License-Identifier: Zlib
#pragma once

#include "command/fit/Task.h"
#include "command/plot/Plot.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace fit {

/// What a fit came to, for programs.
nlohmann::ordered_json jsonOf(const Task& task, const Fit& fit);
/// The same for people, with the part of a scene to copy.
std::string textOf(const Task& task, const Fit& fit);
/// fit_NAME: readings and law; fit_NAME_residuals: what is between them.
std::vector<command::Plot> plotsOf(const Task& task, const Fit& fit);

}  // namespace fit
