// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Bullet's nodes and faces lie further apart than a processor guesses: a loop asks for what it needs so many elements
/// later.
constexpr std::ptrdiff_t kPrefetchedAhead = 12;

/// Asks for memory early. There may be no object at that address.
inline void prefetch(const void* address, std::size_t size) {
#if defined(__GNUC__) || defined(__clang__)
  constexpr std::size_t kCacheLine = 64;
  for (std::size_t offset = 0; offset < size; offset += kCacheLine) {
    __builtin_prefetch(static_cast<const char*>(address) + offset);
  }
#else
  static_cast<void>(address);
  static_cast<void>(size);
#endif
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
