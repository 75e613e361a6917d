// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/SheetBounds.h"

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

struct Middle {
  double at[3];
  double half[3];

  explicit Middle(const GuardBox& box) {
    for (int k = 0; k < 3; ++k) {
      at[k] = (static_cast<double>(box.low[k]) + static_cast<double>(box.high[k])) / 2;
      half[k] = (static_cast<double>(box.high[k]) - static_cast<double>(box.low[k])) / 2;
    }
  }
  double along(const double (&direction)[3]) const {
    return at[0] * direction[0] + at[1] * direction[1] + at[2] * direction[2];
  }
  // How much further any vector of the box reaches along a direction.
  double reach(const double (&direction)[3]) const {
    return half[0] * std::fabs(direction[0]) + half[1] * std::fabs(direction[1]) + half[2] * std::fabs(direction[2]);
  }
  double length() const { return std::sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]); }
};

}  // namespace

// With columns u / |u0| and v / |v0| of the map from the grid to space (u0 and v0 in the middles of the boxes), and two
// directions e1, e2 near them: the symmetric part of the matrix of their components is positive definite for all
// vectors of the boxes when the least of the diagonal is more than the largest beside it.
bool SheetBounds::areOfASheetThatCannotMeetItself() const {
  if (u.isEmpty() || v.isEmpty()) return false;
  constexpr double kLeast = 0.05;  // far beyond what rounding does to numbers near 1
  const Middle a(u);
  const Middle b(v);
  const double lengthOfA = a.length();
  const double lengthOfB = b.length();
  if (!(lengthOfA > 0) || !(lengthOfB > 0)) return false;
  double e1[3], e2[3];
  double length1 = 0, length2 = 0;
  for (int k = 0; k < 3; ++k) e1[k] = a.at[k] / lengthOfA;
  const double skew = b.along(e1) / lengthOfB;
  for (int k = 0; k < 3; ++k) e2[k] = b.at[k] / lengthOfB - skew * e1[k];
  for (const double x : e2) length2 += x * x;
  length2 = std::sqrt(length2);
  if (!(length2 > kLeast)) return false;
  for (double& x : e2) x /= length2;
  // Half of the skew to either side.
  const double turn = skew / (1 + length2);  // the tangent of half the angle, since skew^2 + length2^2 = 1
  double f1[3], f2[3];
  for (int k = 0; k < 3; ++k) {
    f1[k] = e1[k] + turn * e2[k];
    f2[k] = e2[k] - turn * e1[k];
    length1 += f1[k] * f1[k];
  }
  for (int k = 0; k < 3; ++k) {
    f1[k] /= std::sqrt(length1);
    f2[k] /= std::sqrt(length1);
  }
  const double leastU = (a.along(f1) - a.reach(f1)) / lengthOfA;
  const double leastV = (b.along(f2) - b.reach(f2)) / lengthOfB;
  const double across = std::fabs(a.along(f2) / lengthOfA + b.along(f1) / lengthOfB) / 2 +
                        (a.reach(f2) / lengthOfA + b.reach(f1) / lengthOfB) / 2;
  return std::min(leastU, leastV) > across + kLeast;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
