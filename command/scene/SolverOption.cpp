// SPDX-License-Identifier: Zlib
#include "command/scene/SolverOption.h"

#include "command/cli/CommonOptions.h"
#include "command/cli/Errors.h"

namespace command {

void addSolver(CLI::App& app, std::string& solver, const std::string& explanation) {
  app.add_option("--solver", solver, explanation)->check(oneOf("--solver", namesOf(solverNames())));
}

void applySolver(const std::string& solver, WorldKind world, std::optional<wetcloth::ClothSolver::Parameters>& chosen) {
  if (solver.empty()) return;
  const SolverKind kind = valueOf(solverNames(), solver);
  if (kind == SolverKind::wetcloth && world == WorldKind::deformable) {
    throw InputError("wetcloth: --solver = \"" + solver + "\": must be \"bullet\" in the world \"deformable\"");
  }
  choose(kind, chosen);
}

}  // namespace command
