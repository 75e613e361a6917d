// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/numerics/InstructionSet.h"
#include "bullet_wetcloth/numerics/Lanes.h"

#include <type_traits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

#if defined(__GNUC__) || defined(__clang__)

/// Four numbers as one: what a node has, or one number of four nodes.
using Quad = btScalar __attribute__((vector_size(4 * sizeof(btScalar))));

#if defined(__clang__) || __GNUC__ >= 12
#define WETCLOTH_SHUFFLE(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#else
#define WETCLOTH_SHUFFLE(a, b, ...) __builtin_shuffle(a, b, decltype(a > b){__VA_ARGS__})
#endif

/// Rows become columns.
WETCLOTH_INLINE void transpose(const Quad (&rows)[4], Quad (&columns)[4]) {
  const Quad low01 = WETCLOTH_SHUFFLE(rows[0], rows[1], 0, 4, 1, 5);
  const Quad low23 = WETCLOTH_SHUFFLE(rows[2], rows[3], 0, 4, 1, 5);
  const Quad high01 = WETCLOTH_SHUFFLE(rows[0], rows[1], 2, 6, 3, 7);
  const Quad high23 = WETCLOTH_SHUFFLE(rows[2], rows[3], 2, 6, 3, 7);
  columns[0] = WETCLOTH_SHUFFLE(low01, low23, 0, 1, 4, 5);
  columns[1] = WETCLOTH_SHUFFLE(low01, low23, 2, 3, 6, 7);
  columns[2] = WETCLOTH_SHUFFLE(high01, high23, 0, 1, 4, 5);
  columns[3] = WETCLOTH_SHUFFLE(high01, high23, 2, 3, 6, 7);
}

/// Two Quads as one of eight numbers.
template <class Lanes>
WETCLOTH_INLINE Lanes sideBySide(const Quad& low, const Quad& high) {
#if defined(__clang__) || __GNUC__ >= 12
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#else
  return Lanes{low[0], low[1], low[2], low[3], high[0], high[1], high[2], high[3]};
#endif
}

/// Rows of two Quads, each for itself, become columns.
template <class Lanes>
WETCLOTH_INLINE std::enable_if_t<kLaneCount<Lanes> == 8> transpose(const Lanes (&rows)[4], Lanes (&columns)[4]) {
  const Lanes low01 = WETCLOTH_SHUFFLE(rows[0], rows[1], 0, 8, 1, 9, 4, 12, 5, 13);
  const Lanes low23 = WETCLOTH_SHUFFLE(rows[2], rows[3], 0, 8, 1, 9, 4, 12, 5, 13);
  const Lanes high01 = WETCLOTH_SHUFFLE(rows[0], rows[1], 2, 10, 3, 11, 6, 14, 7, 15);
  const Lanes high23 = WETCLOTH_SHUFFLE(rows[2], rows[3], 2, 10, 3, 11, 6, 14, 7, 15);
  columns[0] = WETCLOTH_SHUFFLE(low01, low23, 0, 1, 8, 9, 4, 5, 12, 13);
  columns[1] = WETCLOTH_SHUFFLE(low01, low23, 2, 3, 10, 11, 6, 7, 14, 15);
  columns[2] = WETCLOTH_SHUFFLE(high01, high23, 0, 1, 8, 9, 4, 5, 12, 13);
  columns[3] = WETCLOTH_SHUFFLE(high01, high23, 2, 3, 10, 11, 6, 7, 14, 15);
}

/// One of the four numbers, four times.
template <int index>
WETCLOTH_INLINE Quad splat(const Quad& quad) {
  return WETCLOTH_SHUFFLE(quad, quad, index, index, index, index);
}

/// The numbers of the second, third and first axis; the fourth stays.
WETCLOTH_INLINE Quad turnAxes(const Quad& quad) { return WETCLOTH_SHUFFLE(quad, quad, 1, 2, 0, 3); }

/// The lesser of each two; the second one where either is not a number.
template <class Lanes>
WETCLOTH_INLINE Lanes lesser(const Lanes& a, const Lanes& b) {
#if defined(__SSE__) && !defined(BT_USE_DOUBLE_PRECISION)
  if constexpr (std::is_same_v<Lanes, Quad>) return __builtin_ia32_minps(a, b);
#endif
  return a < b ? a : b;
}
/// The greater of each two; the second one where either is not a number.
template <class Lanes>
WETCLOTH_INLINE Lanes greater(const Lanes& a, const Lanes& b) {
#if defined(__SSE__) && !defined(BT_USE_DOUBLE_PRECISION)
  if constexpr (std::is_same_v<Lanes, Quad>) return __builtin_ia32_maxps(a, b);
#endif
  return a > b ? a : b;
}

/// Bit k tells whether a comparison of two Quads is true of their numbers k.
template <class Mask>
WETCLOTH_INLINE unsigned bitsOf(const Mask& mask) {
#if defined(__SSE__) && !defined(BT_USE_DOUBLE_PRECISION)
  return static_cast<unsigned>(__builtin_ia32_movmskps(reinterpret_cast<Quad>(mask)));
#else
  unsigned bits = 0;
  for (unsigned k = 0; k < 4; ++k) bits |= mask[k] ? 1u << k : 0u;
  return bits;
#endif
}

/// The same of as many numbers as there are lanes.
template <class Lanes, class Mask>
WETCLOTH_INLINE unsigned bitsOfLanes(const Mask& mask) {
  if constexpr (kLaneCount<Lanes> == 4) {
    return bitsOf(mask);
  } else if constexpr (kLaneCount<Lanes> == 8) {
    return bitsOf(WETCLOTH_SHUFFLE(mask, mask, 0, 1, 2, 3)) | bitsOf(WETCLOTH_SHUFFLE(mask, mask, 4, 5, 6, 7)) << 4;
  } else {
    unsigned bits = 0;
    for (unsigned k = 0; k < kLaneCount<Lanes>; ++k) bits |= mask[k] ? 1u << k : 0u;
    return bits;
  }
}

#undef WETCLOTH_SHUFFLE

/// The number of the lowest bit that is set; one is.
WETCLOTH_INLINE unsigned lowestBit(unsigned bits) { return static_cast<unsigned>(__builtin_ctz(bits)); }

#else

/// Four numbers as one.
struct Quad {
  btScalar at[4];
  btScalar& operator[](int k) { return at[k]; }
  btScalar operator[](int k) const { return at[k]; }
};
inline Quad operator+(Quad a, const Quad& b) {
  for (int k = 0; k < 4; ++k) a[k] += b[k];
  return a;
}
inline Quad operator-(Quad a, const Quad& b) {
  for (int k = 0; k < 4; ++k) a[k] -= b[k];
  return a;
}
inline Quad operator*(Quad a, const Quad& b) {
  for (int k = 0; k < 4; ++k) a[k] *= b[k];
  return a;
}
inline void transpose(const Quad (&rows)[4], Quad (&columns)[4]) {
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 4; ++k) columns[i][k] = rows[k][i];
  }
}
template <int index>
inline Quad splat(const Quad& quad) {
  return {{quad[index], quad[index], quad[index], quad[index]}};
}
inline Quad turnAxes(const Quad& quad) { return {{quad[1], quad[2], quad[0], quad[3]}}; }

#endif

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
