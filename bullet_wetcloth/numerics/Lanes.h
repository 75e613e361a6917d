// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/numerics/InstructionSet.h"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

// Several numbers as one, with + - * / and comparisons, as GCC and Clang have them. Every operation is that of one
// number in each lane, so results do not depend on how many there are.
#if defined(__GNUC__) || defined(__clang__)
using NarrowLanes = btScalar __attribute__((vector_size(16)));  ///< what SSE2 and NEON do at once
using WideLanes = btScalar __attribute__((vector_size(32)));    ///< what AVX2 does at once
#else
using NarrowLanes = btScalar;
using WideLanes = btScalar;
#endif

template <class Lanes>
constexpr std::size_t kLaneCount = sizeof(Lanes) / sizeof(btScalar);

template <class Lanes>
WETCLOTH_INLINE Lanes everywhere(btScalar x) {
  if constexpr (kLaneCount<Lanes> < 8) {
    return x - Lanes();
  } else {
    // As integers: GCC 12 puts a number into eight lanes one by one.
    using Integers = decltype(Lanes() > Lanes());
    std::decay_t<decltype(Integers()[0])> bits;
    static_assert(sizeof bits == sizeof x);
    std::memcpy(&bits, &x, sizeof x);
    const Integers all = bits | Integers();
    Lanes lanes;
    std::memcpy(&lanes, &all, sizeof lanes);
    return lanes;
  }
}

template <class Lanes>
WETCLOTH_INLINE Lanes load(const btScalar* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

template <class Lanes>
WETCLOTH_INLINE void store(btScalar* to, const Lanes& lanes) {
  std::memcpy(to, &lanes, sizeof lanes);
}

/// `yes` where the mask, a comparison, is true, and `no` elsewhere.
template <class Mask, class Lanes>
WETCLOTH_INLINE Lanes choose(const Mask& mask, const Lanes& yes, const Lanes& no) {
  return mask ? yes : no;
}

template <class Lanes>
WETCLOTH_INLINE Lanes squareRoot(const Lanes& x) {
  if constexpr (std::is_same_v<Lanes, btScalar>) {
    return std::sqrt(x);
  } else {
    Lanes root = x;
    for (std::size_t k = 0; k < kLaneCount<Lanes>; ++k) root[k] = std::sqrt(x[k]);
    return root;
  }
}

template <class Lanes>
WETCLOTH_INLINE Lanes absolute(const Lanes& x) {
  return choose(x > Lanes(), x, -x);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
