// SPDX-License-Identifier: Zlib
#include "command/timing/ProcessorTime.h"

#include <algorithm>
#include <chrono>
#include <ctime>

namespace command {

double processorTime() {
// Windows counts a thread's time in ticks of 1/64 s.
#if defined(CLOCK_THREAD_CPUTIME_ID) && !defined(_WIN32)
  timespec time{};
  if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time) == 0) {
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
#endif
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double atLeastATick(double seconds) { return std::max(seconds, 1e-9); }

}  // namespace command
