// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btThreads.h>

#include <algorithm>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Elements of a loop that a thread takes at once, at least: what wakes it costs some microseconds.
constexpr std::size_t kPartSize = 16384;

/// Calls action(part) for each part, of which each has work of its own: by Bullet's task scheduler where the
/// application has set one with several threads, else one after the other. What it does must not depend on the order.
template <class Action>
void forEachPart(std::size_t parts, const Action& action) {
  btITaskScheduler* const scheduler = btGetTaskScheduler();
  if (parts < 2 || !scheduler || scheduler->getNumThreads() < 2) {
    for (std::size_t part = 0; part < parts; ++part) action(part);
    return;
  }
  struct Body : btIParallelForBody {
    explicit Body(const Action& what) : action(what) {}
    void forLoop(int begin, int end) const override {
      for (int part = begin; part < end; ++part) action(static_cast<std::size_t>(part));
    }
    const Action& action;
  };
  scheduler->parallelFor(0, static_cast<int>(parts), 1, Body(action));
}

/// Calls action(begin, end) for stretches of a loop over so many elements, in the same way.
template <class Action>
void forEachStretch(std::size_t count, const Action& action) {
  const std::size_t parts = (count + kPartSize - 1) / kPartSize;
  forEachPart(parts, [&](std::size_t part) { action(part * kPartSize, std::min(count, (part + 1) * kPartSize)); });
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
