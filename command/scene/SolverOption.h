// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace command {

/// --solver, empty unless it is given.
void addSolver(
    CLI::App& app, std::string& solver,
    const std::string& explanation = "Who steps the cloths, instead of the scene's choice, with its numbers");

/// What --solver says overrules `chosen`, whose numbers stay. Throws InputError where the world has no such solver.
void applySolver(const std::string& solver, WorldKind world, std::optional<wetcloth::ClothSolver::Parameters>& chosen);

}  // namespace command
