// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/SheetBounds.h"

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// The middle of a box of vectors, and how much further they reach on each axis.
struct Middle {
  Quad at;
  Quad half;

  WETCLOTH_INLINE explicit Middle(const GuardBox& box) {
    constexpr Quad kHalf = {btScalar(0.5), btScalar(0.5), btScalar(0.5), 0};  // the fourth number is no place
    at = (box.low + box.high) * kHalf;
    half = (box.high - box.low) * kHalf;
  }
};

WETCLOTH_INLINE Quad sumsOf(const Quad (&rows)[4]) {
  Quad columns[4];
  transpose(rows, columns);
  return columns[0] + columns[1] + columns[2];
}

}  // namespace

// With columns u / |u0| and v / |v0| of the map from the grid to space (u0 and v0 in the middles of the boxes), and two
// directions f1, f2 across each other in the plane of both, as far from u0 as from v0: the symmetric part of the matrix
// of their components is positive definite for all vectors of the boxes when the least of the diagonal is more than the
// largest beside it. With s the cosine between u0 and v0,
//   f1 = alpha u0/|u0| - beta v0/|v0|,  f2 = alpha v0/|v0| - beta u0/|u0|,
//   alpha, beta = (1/sqrt(1 - s) +- 1/sqrt(1 + s)) / 2.
bool SheetBounds::areOfASheetThatCannotMeetItself() const {
  if (u.isEmpty() || v.isEmpty()) return false;
  constexpr btScalar kLeast = btScalar(0.05);   // far beyond what rounding does to numbers near 1
  constexpr btScalar kAcross = btScalar(0.01);  // least square of the sine between u0 and v0
  const Middle a(u);
  const Middle b(v);
  const Quad products = sumsOf({a.at * a.at, b.at * b.at, a.at * b.at, a.at});
  const btScalar perLengthOfA = 1 / std::sqrt(products[0]);
  const btScalar perLengthOfB = 1 / std::sqrt(products[1]);
  const btScalar s = products[2] * perLengthOfA * perLengthOfB;
  if (!(1 - s * s > kAcross)) return false;  // nor where a length is 0
  const btScalar plus = std::sqrt(1 + s);
  const btScalar minus = std::sqrt(1 - s);
  const btScalar alpha = (1 / minus + 1 / plus) / 2;
  const btScalar beta = (1 / minus - 1 / plus) / 2;
  const Quad unitA = a.at * everywhere<Quad>(perLengthOfA);
  const Quad unitB = b.at * everywhere<Quad>(perLengthOfB);
  const Quad f1 = absolute(unitA * everywhere<Quad>(alpha) - unitB * everywhere<Quad>(beta));
  const Quad f2 = absolute(unitB * everywhere<Quad>(alpha) - unitA * everywhere<Quad>(beta));
  const Quad reach = sumsOf({a.half * f1, b.half * f2, a.half * f2, b.half * f1}) *
                     Quad{perLengthOfA, perLengthOfB, perLengthOfA, perLengthOfB};
  const btScalar least = (plus + minus) / 2 - std::max(reach[0], reach[1]);
  const btScalar across = (std::fabs(plus - minus) + reach[2] + reach[3]) / 2;
  return least > across + kLeast;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
