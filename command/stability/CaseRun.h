// SPDX-License-Identifier: Zlib
#pragma once

#include "command/stability/CaseMeter.h"
#include "command/stability/HardCase.h"

#include <optional>

namespace stability {

/// How long the long cases are run.
enum class Effort { full, quick };

/// Runs a case in one world at one step, in one way, until its end or until a number is not finite.
/// @param world  one of the case's; @param dt  of each step [s], > 0
CaseMeter runCase(const HardCase& hardCase, World world, Way way, double dt, Effort effort = Effort::full);

/// A case in one world at one step: ours, plain Bullet and, where there is one, the naive method.
struct CaseResult {
  enum class Verdict {
    holds,
    fails,
    bulletFails  ///< whatever bound ours fails, the same case without any effect of ours fails, too
  };

  const HardCase* hardCase;
  World world;
  double step;  ///< [s]
  CaseMeter ours;
  /// None for cases without a world. Dry, or, where ours fails what that holds, wet.
  std::optional<CaseMeter> plainBullet;
  std::optional<CaseMeter> naiveMethod;

  Verdict verdict() const;
};

/// What is run beside ours.
enum class Comparisons {
  all,         ///< plain Bullet and the naive method
  whereNeeded  ///< plain Bullet, and that only where ours does not hold
};

CaseResult tryCase(const HardCase& hardCase, World world, double dt, Effort effort = Effort::full,
                   Comparisons comparisons = Comparisons::all);

const char* nameOf(CaseResult::Verdict verdict);

}  // namespace stability
