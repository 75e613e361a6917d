// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <cstddef>
#include <new>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Memory that begins with a cache line: what a processor works on at once then lies in one of them.
template <class T>
struct LaneAllocator {
  /// What it allocates.
  using value_type = T;
  /// Of the first element [bytes].
  static constexpr std::align_val_t kAlignment{64};

  LaneAllocator() = default;
  /// For another type; there is nothing to take over.
  template <class Other>
  LaneAllocator(const LaneAllocator<Other>&) {}

  /// Room for so many. Throws std::bad_alloc.
  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kAlignment)); }
  /// Gives it back.
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, kAlignment); }
  /// Any gives back what another has allocated.
  friend bool operator==(const LaneAllocator&, const LaneAllocator&) { return true; }
  /// The opposite.
  friend bool operator!=(const LaneAllocator&, const LaneAllocator&) { return false; }
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
