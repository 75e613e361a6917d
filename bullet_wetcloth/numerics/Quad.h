// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/numerics/InstructionSet.h"
#include "bullet_wetcloth/numerics/Lanes.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

#if defined(__GNUC__) || defined(__clang__)

/// Four numbers as one: what a node has, or one number of four nodes.
using Quad = btScalar __attribute__((vector_size(4 * sizeof(btScalar))));

#if defined(__clang__) || __GNUC__ >= 12
#define WETCLOTH_SHUFFLE(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, k, l)
#else
using QuadIndex = decltype(Quad() > Quad());
#define WETCLOTH_SHUFFLE(a, b, i, j, k, l) __builtin_shuffle(a, b, QuadIndex{i, j, k, l})
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

/// One of the four numbers, four times.
template <int index>
WETCLOTH_INLINE Quad splat(const Quad& quad) {
  return WETCLOTH_SHUFFLE(quad, quad, index, index, index, index);
}

#undef WETCLOTH_SHUFFLE

/// The lesser of each two; the second one where either is not a number.
WETCLOTH_INLINE Quad lesser(const Quad& a, const Quad& b) {
#if defined(__SSE__) && !defined(BT_USE_DOUBLE_PRECISION)
  return __builtin_ia32_minps(a, b);
#else
  return a < b ? a : b;
#endif
}
/// The greater of each two; the second one where either is not a number.
WETCLOTH_INLINE Quad greater(const Quad& a, const Quad& b) {
#if defined(__SSE__) && !defined(BT_USE_DOUBLE_PRECISION)
  return __builtin_ia32_maxps(a, b);
#else
  return a > b ? a : b;
#endif
}

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

#endif

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
