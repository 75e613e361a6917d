// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/water/WaterPace.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

void requireValid(const WaterPace& pace) {
  if (pace.everySubsteps < 1 || pace.everySubsteps > 1000) {
    rejectValue("WaterPace.everySubsteps", pace.everySubsteps, "a number from 1 to 1000");
  }
  requirePositive("WaterPace.longestStep", pace.longestStep);
  if (!(pace.massTolerance >= 0 && pace.massTolerance <= 0.1)) {
    rejectValue("WaterPace.massTolerance", pace.massTolerance, "in [0, 0.1]");
  }
}

int WaterPace::substepsOf(double dt) const {
  constexpr double rounding = 1 + 1e-6;  // of a substep in float
  const double most = std::floor(longestStep / dt * rounding);
  return most < everySubsteps ? std::max(static_cast<int>(most), 1) : everySubsteps;
}

// In the middle of n substeps of dt it moves by n dt, so that it is exact at their end.
WaterClock::Turn WaterClock::tick(double dt, int n) {
  m_ahead -= dt;
  if (m_count >= n) m_count = 0;
  const bool isTurn = m_count == n / 2;
  m_count = m_count + 1 == n ? 0 : m_count + 1;
  if (!isTurn) return {0, 0};
  const int substepsLeft = n - 1 - n / 2;
  const double ahead = substepsLeft * dt;
  const double length = ahead - m_ahead;
  if (!(length > 0)) return {0, 0};  // substeps have become shorter
  m_ahead = ahead;
  return {dt + (ahead - length), length};
}

void WaterClock::transferState(StateArchive& archive) { archive.value(m_ahead, m_count); }

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
