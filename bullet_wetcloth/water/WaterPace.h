// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// How often a cloth's water moves, and when its weight follows. Water moves in seconds, cloth in milliseconds: both at
/// the same rate is exact and dear. What the defaults cost in accuracy is in docs/accuracy.md: less than 0.1 %.
struct WETCLOTH_EXPORT WaterPace {
  /// Sources, transport, losses and what water changes in the fabric run once in so many substeps, 1 to 1000, over the
  /// time of all of them, in the middle one. Their laws hold for any time. With an odd number water is as long ahead of
  /// the cloth as behind it, so that its delay cancels; 1: in every substep.
  int everySubsteps = 5;
  /// But no less often than this [s], > 0: with longer substeps it moves in fewer of them, and beyond in each.
  double longestStep = 0.1;
  /// Masses, momentum of what arrived, and links' constants are written when at some node they would change its mass by
  /// more than this share, [0, 0.1], or when water has come to rest. Nothing is lost meanwhile. 0: whenever water
  /// moved.
  double massTolerance = 1e-3;

  /// Water and weight in every substep: the most exact.
  static WaterPace exact() { return {1, 0.1, 0}; }

  /// In how many substeps of this length water moves once [s].
  int substepsOf(double dt) const;
};

/// Throws std::invalid_argument naming the field and its value when it is out of its range.
WETCLOTH_EXPORT void requireValid(const WaterPace& pace);

/// Tells in which substeps a cloth's water moves, and for how long.
class WETCLOTH_EXPORT WaterClock {
 public:
  /// What is to be done in a substep.
  struct Turn {
    double start;  ///< of water's step, after the start of the substep [s]; mostly negative
    double dt;     ///< its length [s]; 0: water rests in this substep
  };
  /// A substep of this length begins [s], > 0; water moves in every n-th, n >= 1. Water's own time never runs back.
  Turn tick(double dt, int n);

  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive);

 private:
  double m_ahead = 0;  // water's time after the end of the last substep [s]
  int m_count = 0;     // substeps since water's turn began
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
