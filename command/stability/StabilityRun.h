// SPDX-License-Identifier: Zlib
#pragma once

#include "command/stability/CaseRun.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stability {

/// Which part of the table is run. Empty: all.
struct Selection {
  std::string name;
  std::string group;
  std::optional<World> world;
  std::optional<double> step;  ///< [s], > 0
  Effort effort = Effort::full;
};

/// A case in a world at a step; the step is 0 where there is no world.
struct Combination {
  const HardCase* hardCase;
  World world;
  double step;
};

/// In the order of the table.
std::vector<Combination> combinationsOf(const Selection& selection);

/// Runs them on all processors and returns the results in the same order.
/// @param progress  called now and then from this thread with the share that is done, [0, 1]
std::vector<CaseResult> runCombinations(const std::vector<Combination>& combinations, Effort effort,
                                        const std::function<void(double)>& progress);

}  // namespace stability
