// SPDX-License-Identifier: Zlib
#pragma once

namespace command {

/// Processor time that this thread has taken [s]; where there is no such clock, time. What a process that takes the
/// core for a while needs does not count.
double processorTime();

}  // namespace command
