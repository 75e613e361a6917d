// SPDX-License-Identifier: Zlib
#pragma once

namespace command {

/// Processor time that this thread has taken [s]; where there is no such clock, time. What a process that takes the
/// core for a while needs does not count.
double processorTime();

/// A measured time that may be divided by [s]: a nanosecond where the clock did not tick, as some do so rarely that
/// they show no time for work that took some.
double atLeastATick(double seconds);

}  // namespace command
