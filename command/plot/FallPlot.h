// SPDX-License-Identifier: Zlib
#pragma once

#include "command/fall/Fall.h"
#include "command/plot/Plot.h"

namespace command {

/// What stays of the mode's height [m] over the time [s] while one cloth falls to the floor. Throws RunError when the
/// cloth blows up.
PlotSeries descend(const FallMode& mode, const FallMode::Case& fallCase);

}  // namespace command
