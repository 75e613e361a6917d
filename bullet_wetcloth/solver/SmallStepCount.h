// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/ClothSolver.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// How many small steps the next step of a cloth has.
///
/// All are about as long. One pass over the links leaves an error that becomes a velocity by the small step's length: a
/// small step that is much shorter than the last one would kick the cloth. So only steps that are all
/// alike get more of them than their length asks for, 4 where that is 1 or 2; and then each is at least half as long as
/// the last.
class SmallStepCount {
 public:
  /// Where all steps are dt [s] long, after the first few.
  static int inSteadySteps(const ClothSolver::Parameters& parameters, double dt);
  /// For a step of dt [s] now. @param isCrumpled  links are far from their lengths: a first step is no steady one then
  int of(const ClothSolver::Parameters& parameters, double dt, bool isCrumpled) const;
  /// Whether there was a step.
  bool hasStepped() const { return m_step > 0; }
  /// A step of dt [s] had so many.
  void had(double dt, int count);
  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive);

 private:
  double m_step = 0;    // the last one [s]; 0: there was none
  double m_length = 0;  // of its small steps [s]
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
