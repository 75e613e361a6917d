// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/collision/CoplanarityCubic.h"

#include "bullet_wetcloth/collision/PointDifferences.h"
#include "bullet_wetcloth/collision/ToDouble.h"

#include <cmath>
#include <limits>

namespace wetcloth::collision {
namespace {

/// Rounding of a coefficient, in units of the roundoff u times |x||y||z| of the vectors: an inner one is a third of
/// three determinants of 6 products, each product rounded up to 7 times, its three factors wrong by u each, and the
/// division by 3 adds one: 6 * (7 + 3 + 1). The outer ones have less. Rounded up for the terms of second order and the
/// rounding of the bound itself.
constexpr double kCoefficient = 67;

/// What underflow adds: at most 30 operations wrong by 2^-1022 (a flushed denormal), times two further factors.
double underflow(double largest) { return 0x1p-1010 * (1 + largest) * (1 + largest); }

}  // namespace

double CoplanarityCubic::value(double t) const {
  const double s = 1 - t;
  double b[4] = {bernstein[0], bernstein[1], bernstein[2], bernstein[3]};
  for (int level = 3; level > 0; --level)
    for (int i = 0; i < level; ++i) b[i] = s * b[i] + t * b[i + 1];
  return b[0];
}

bool CoplanarityCubic::hasNoRoot() const {
  bool positive = true;
  bool negative = true;
  for (const double coefficient : bernstein) {
    positive = positive && coefficient > error;
    negative = negative && coefficient < -error;
  }
  return positive || negative;
}

template <class Scalar>
CoplanarityCubic coplanarityCubic(const Query<Scalar>& query) noexcept {
  const Query<double>& wide = toDouble(query);
  const auto start = differences<Pair::vertexFace>(wide.start);
  const auto end = differences<Pair::vertexFace>(wide.end);
  const auto& a = start.vectors;
  const auto& b = end.vectors;
  const Vector mixed = a[1].cross(b[2]) + b[1].cross(a[2]);
  const Vector first = a[1].cross(a[2]);
  const Vector last = b[1].cross(b[2]);
  CoplanarityCubic cubic;
  cubic.bernstein[0] = a[0].dot(first);
  cubic.bernstein[1] = (b[0].dot(first) + a[0].dot(mixed)) / 3;
  cubic.bernstein[2] = (b[0].dot(mixed) + a[0].dot(last)) / 3;
  cubic.bernstein[3] = b[0].dot(last);
  const Vector size = magnitude<Pair::vertexFace>(a, b);
  cubic.error = kCoefficient * kRoundoff * (size[0] * size[1] * size[2]) + underflow(size.maxCoeff());
  double sum = cubic.error;
  for (const double coefficient : cubic.bernstein) sum += coefficient;
  for (const double coordinate : {a[0].sum(), a[1].sum(), a[2].sum(), b[0].sum(), b[1].sum(), b[2].sum()})
    sum += coordinate * 0;
  if (!std::isfinite(sum)) cubic.error = std::numeric_limits<double>::infinity();
  return cubic;
}

template CoplanarityCubic coplanarityCubic(const Query<float>&) noexcept;
template CoplanarityCubic coplanarityCubic(const Query<double>&) noexcept;

}  // namespace wetcloth::collision
