// SPDX-License-Identifier: Zlib
#include "command/run/FiniteState.h"

#include "command/cli/Errors.h"

#include <cstdio>

namespace command {

void requireFinite(const SceneWorld& world, int step) {
  if (world.isFinite()) return;
  char when[96];
  std::snprintf(when, sizeof when, "the state became non-finite in step %d (t = %g s)", step,
                step * world.scene().step);
  throw RunError(world.scene().file + ": " + when + "; try more substeps or a smaller step_s");
}

}  // namespace command
