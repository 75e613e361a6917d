// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/SmallStepCount.h"

#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kSameLength = 1e-4;  // what two lengths of a step may differ by, as a share

// By the length of a step [s] alone.
int usualCount(const ClothSolver::Parameters& parameters, double dt) {
  constexpr double kMost = 1000;
  const double count = std::ceil(dt * ClothSolver::kSmallStepsPer * parameters.smallSteps * (1 - kSameLength));
  return static_cast<int>(std::min(std::max(count, 1.0), kMost));
}

}  // namespace

int SmallStepCount::inSteadySteps(const ClothSolver::Parameters& parameters, double dt) {
  constexpr int kEnough = 3;
  constexpr int kInstead =
      4;  // of one or two: light cloths, and cloths under weights, need some passes in a short step
  const int count = usualCount(parameters, dt);
  return count >= kEnough ? count : std::max(count, std::min(kInstead, parameters.smallSteps));
}

int SmallStepCount::of(const ClothSolver::Parameters& parameters, double dt, bool isCrumpled) const {
  if (!hasStepped() && !isCrumpled) return inSteadySteps(parameters, dt);
  const bool isLikeTheLast = hasStepped() && std::fabs(dt - m_step) <= kSameLength * m_step;
  if (!isLikeTheLast) return usualCount(parameters, dt);
  const double most = std::max(std::floor(2 * dt / m_length * (1 + kSameLength)), 1.0);
  return static_cast<int>(std::min<double>(inSteadySteps(parameters, dt), most));
}

void SmallStepCount::had(double dt, int count) {
  m_step = dt;
  m_length = dt / count;
}

void SmallStepCount::transferState(StateArchive& archive) { archive.value(m_step, m_length); }

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
