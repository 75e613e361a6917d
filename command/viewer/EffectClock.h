// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/bullet_wetcloth.h"

#include <chrono>
#include <cstddef>
#include <memory>
#include <vector>

namespace viewer {

/// What the parts of a world's step take. Laps, effects that only look at the clock, stand behind each effect: a part
/// takes from the lap before to its own.
class EffectClock {
 public:
  using Part = std::size_t;

  Part addPart();
  /// An effect that ends a part, at the stage of the effect before it.
  std::unique_ptr<wetcloth::Effect> endOf(Part part, wetcloth::Stage stage);
  /// An effect that begins a part: what went before it counts for none.
  std::unique_ptr<wetcloth::Effect> beginning(wetcloth::Stage stage);

  void beginStep();
  void endStep();
  /// Forgets what was measured.
  void clear();

  /// Per step of the scene, over the last half second or so [us].
  double microseconds(Part part) const { return m_averages[part]; }
  /// The same of the whole step.
  double stepMicroseconds() const { return m_stepAverage; }

 private:
  class Lap;
  using Clock = std::chrono::steady_clock;

  void lap(Part part);
  void average(double microseconds, double& average) const;

  static constexpr Part noPart = static_cast<Part>(-1);
  Clock::time_point m_start;
  Clock::time_point m_last;
  std::vector<double> m_now;  // in the step that runs [us]
  std::vector<double> m_averages;
  double m_stepAverage = 0;
  long long m_steps = 0;
};

}  // namespace viewer
