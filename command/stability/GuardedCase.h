// SPDX-License-Identifier: Zlib
#pragma once

#include "command/stability/HardCase.h"

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <functional>
#include <memory>
#include <string>

namespace stability {

/// A case on ClothSolver, with this guard and without one. `build` wets no cloth.
HardCase guarded(std::string name, std::string about, const wetcloth::ClothSolver::Guard& guard,
                 std::function<Script(CaseScene&)> build);

/// A cloth that meets rigid bodies 1 cm away.
btSoftBody& addCloth(CaseScene& scene, std::unique_ptr<btSoftBody> cloth);
btSoftBody& addCloth(CaseScene& scene, const wetcloth::ClothPatch& patch);

}  // namespace stability
