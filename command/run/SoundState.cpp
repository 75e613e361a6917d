// SPDX-License-Identifier: Zlib
#include "command/run/SoundState.h"

#include "command/cli/Errors.h"

#include <cstdio>

namespace command {

void requireSound(const SceneWorld& world, int step) {
  const auto blowUp = world.blowUp();
  if (!blowUp) return;
  const Scene& scene = world.scene();
  char when[96];
  std::snprintf(when, sizeof when,
                "%s in step %d (t = %g s): ", world.isFinite() ? "the cloth blew up" : "the state became non-finite",
                step, step * scene.step);
  const bool hasBulletsSprings = scene.world == WorldKind::deformable && !scene.implicit;
  throw RunError(scene.file + ": " + when + *blowUp + "; try more substeps or a smaller step_s" +
                 (hasBulletsSprings ? ", a smaller spring_stiffness_n_m, or the effect hooke_springs" : ""));
}

}  // namespace command
