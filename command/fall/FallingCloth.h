// SPDX-License-Identifier: Zlib
#pragma once

#include "command/fall/Fall.h"
#include "command/scene/BulletWorld.h"

#include <optional>
#include <string>

namespace command {

/// A level cloth of 32 x 32 nodes that falls from rest.
class FallingCloth {
 public:
  /// @param clothSolver  steps it, but in plain Bullet; none: Bullet's own
  FallingCloth(const FallMode& mode, const FallMode::Case& fallCase, WorldKind kind,
               const std::optional<wetcloth::ClothSolver::Parameters>& clothSolver = std::nullopt);

  /// One of fallSubstep.
  void substep();
  /// Since the start [s].
  double time() const { return static_cast<double>(m_substeps) * fallSubstep; }
  /// How far the centre of mass has fallen [m].
  double fallen() const { return m_fallen; }
  /// "node 7 moves with ...", what of the cloth has blown up; none while it is sound.
  std::optional<std::string> blowUp() const;

 private:
  BulletWorld m_world;
  btSoftBody* m_body;
  long long m_substeps = 0;
  double m_fallen = 0;
  double m_lifted = 0;  // [m], see liftByOneMetre()
};

}  // namespace command
