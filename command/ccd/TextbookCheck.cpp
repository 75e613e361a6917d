// SPDX-License-Identifier: Zlib
#include "command/ccd/TextbookCheck.h"

#include "command/ccd/ComparisonParts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace command::comparison {
namespace {

/// Real roots of c + b x + a x^2 + x^3 in ascending order.
template <class Scalar>
int cardanoRoots(Scalar a, Scalar b, Scalar c, Scalar* roots) {
  const Scalar shift = a / 3;
  const Scalar q = (a * a - 3 * b) / 9;
  const Scalar r = (2 * a * a * a - 9 * a * b + 27 * c) / 54;
  const Scalar discriminant = q * q * q - r * r;
  if (discriminant > 0) {
    const Scalar thirdTurn = Scalar(2.0943951023931954923);
    const Scalar size = 2 * std::sqrt(q);
    const Scalar angle = std::acos(std::clamp(r / (q * std::sqrt(q)), Scalar(-1), Scalar(1))) / 3;
    roots[0] = -size * std::cos(angle) - shift;
    roots[1] = -size * std::cos(angle - thirdTurn) - shift;
    roots[2] = -size * std::cos(angle + thirdTurn) - shift;
    return 3;
  }
  const Scalar s = -std::copysign(std::cbrt(std::abs(r) + std::sqrt(-discriminant)), r);
  const Scalar t = s == 0 ? 0 : q / s;
  roots[0] = s + t - shift;
  if (discriminant < 0) return 1;
  roots[1] = Scalar(-0.5) * (s + t) - shift;
  if (roots[0] > roots[1]) std::swap(roots[0], roots[1]);
  return 2;
}

/// The formula divides by the leading coefficient, and a root is lost in its rounding when that one is far smaller than
/// the others: what dropping it costs and what keeping it costs are about equal here.
template <class Scalar>
int rootsOf(const PowerCubic<Scalar>& cubic, Scalar* roots) {
  const Scalar* const a = cubic.a;
  const Scalar negligible = std::sqrt(std::numeric_limits<Scalar>::epsilon());
  const Scalar largest = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
  if (std::abs(a[3]) > negligible * largest) return cardanoRoots(a[2] / a[3], a[1] / a[3], a[0] / a[3], roots);
  const bool isQuadratic = std::abs(a[2]) > negligible * std::max(std::abs(a[0]), std::abs(a[1]));
  return quadraticRoots(isQuadratic ? a[2] : 0, a[1], a[0], roots);
}

}  // namespace

template <class Scalar>
Contact textbookCheck(Pair pair, const Query<Scalar>& query, Scalar tolerance) noexcept {
  const Motion<Scalar> motion(query);
  Scalar roots[3];
  const int count = rootsOf(PowerCubic<Scalar>(motion), roots);
  Contact contact;
  for (int i = 0; i < count; ++i) {
    if (!(roots[i] >= -tolerance && roots[i] <= 1 + tolerance)) continue;
    const Scalar time = std::clamp(roots[i], Scalar(0), Scalar(1));
    if (meetInPlane(pair, motion, time, tolerance, contact)) break;
  }
  return contact;
}

template Contact textbookCheck(Pair pair, const Query<float>& query, float tolerance) noexcept;
template Contact textbookCheck(Pair pair, const Query<double>& query, double tolerance) noexcept;

}  // namespace command::comparison
