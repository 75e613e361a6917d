// SPDX-License-Identifier: Zlib
#include "command/scene/SoundState.h"

#include "command/cli/Errors.h"

#include <cstdio>

namespace command {

std::optional<std::string> describeBlowUp(const SceneWorld& world, double otherPush) {
  const auto blowUp = world.blowUp(otherPush);
  if (!blowUp) return std::nullopt;
  const Scene& scene = world.scene();
  char when[96];
  std::snprintf(when, sizeof when,
                "%s in step %d (t = %g s): ", world.isFinite() ? "the cloth blew up" : "the state became non-finite",
                world.steps(), world.time());
  const bool hasBulletsSprings = scene.world == WorldKind::deformable && !scene.implicit;
  return when + *blowUp + "; try more substeps or a smaller step_s" +
         (hasBulletsSprings ? ", a smaller spring_stiffness_n_m, or the effect hooke_springs" : "");
}

void requireSound(const SceneWorld& world) {
  if (const auto blowUp = describeBlowUp(world)) throw RunError(world.scene().file + ": " + *blowUp);
}

void requireSound(const std::optional<std::string>& blowUp, double time, const std::string& remedy) {
  if (!blowUp) return;
  throw RunError("wetcloth: the cloth blew up after " + std::to_string(time) + " s: " + *blowUp + remedy);
}

}  // namespace command
