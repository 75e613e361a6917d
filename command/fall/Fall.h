// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <optional>
#include <string>
#include <vector>

namespace command {

constexpr double fallGravity = 9.81;       ///< [m/s^2]
constexpr double fallSubstep = 1.0 / 240;  ///< [s]
constexpr int fallSubstepsPerFrame = 4;    ///< a frame is 1/60 s

/// A fabric and air that falls are compared in, and how wet they are.
struct FallMode {
  struct Case {
    std::string name;
    double massRatio;   ///< wet over dry
    bool inAir = true;  ///< false: plain Bullet, which knows no air
  };

  std::string name;
  double defaultHeight;  ///< [m]
  wetcloth::Fabric fabric;
  wetcloth::Wind::Parameters air;
  std::vector<Case> cases;
  std::string remark;  ///< what the table shows, in one line

  /// Table II of the paper and a drag that is linear in speed, m_dry / c = 0.585 s.
  static FallMode paper();
  /// Cotton of 150 g/m^2 and a drag that grows with speed squared.
  static FallMode physical();

  /// Time of a fall from `height` by the closed form [s].
  double closedForm(const Case& fall, double height) const;
  /// How far it has fallen after `time` [s] by the closed form [m].
  double closedFormFallen(const Case& fall, double time) const;
};

struct FallResult {
  std::string name;
  double massRatio;
  double time;        ///< [s]
  double closedForm;  ///< [s]
  double fps;         ///< frames of 1/60 s per second of wall-clock time
};

/// Lets a level cloth of 32 x 32 nodes fall, until its centre of mass has fallen `height`.
/// @param clothSolver  steps it, but in plain Bullet; none: Bullet's own
/// Throws RunError when it never does.
FallResult fall(const FallMode& mode, const FallMode::Case& fallCase, double height, WorldKind kind,
                const std::optional<wetcloth::ClothSolver::Parameters>& clothSolver = std::nullopt);

}  // namespace command
