// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/collision/IntervalTest.h"

#include <algorithm>

namespace wetcloth::collision {
namespace {

// The constants below count, in units of the roundoff u, how far a computed value may be from that of the exact motion.
// They are rounded up; the second-order terms and the rounding of the bounds themselves (a few u, relative) are far
// below what the rounding up leaves.

/// A vector at a time in (0, 1): u of its magnitude from the subtraction of the points, which the blend (1 - t) a + t b
/// passes on, 2 u of its own (a product and the sum). At times 0 and 1: the subtraction's u alone.
constexpr double kInside = 3.01;
constexpr double kAtEnds = 1;

/// Dot product of a direction, which is what it is, with a vector: 3 u (a product, two sums) and the vector's kInside.
constexpr double kDot = 6.1;

/// Outer coefficients: one determinant, 6 products of three. Each product is rounded 5 times (product, difference of
/// the cross product; product, two sums of the dot product): 6 * 5 u of |x||y||z|.
constexpr double kOuterRounding = 30.1;
/// ... and each of its three factors carries its own error: 6 times the sum over the axes.
constexpr double kOuterInput = 6.01;
/// Inner coefficients, times three: three determinants, each product rounded up to 7 times: 18 * 7 u.
constexpr double kInnerRounding = 126.1;
constexpr double kInnerInput = 18.01;

double sumOfProducts(const Vector& magnitude, const Vector& local) {
  return magnitude[0] * local[1] * local[2] + local[0] * magnitude[1] * local[2] + local[0] * local[1] * magnitude[2];
}

/// Upper bound on the longest of three vectors whose components are wrong by at most `error` each.
double longest(const Vector& a, const Vector& b, const Vector& c, double error) {
  const double square = std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()});
  // 1 + 2^-50: the squares, their sum and the root are rounded 4 times at most. Two errors: sqrt(3) < 2.
  return std::sqrt(square) * (1 + 0x1p-50) + 2 * error;
}

}  // namespace

template <Pair pair>
void IntervalTest<pair>::choose(double t0, double t1) {
  m_whole = t0 == 0 && t1 == 1;
  m_first = vectorsAt(t0, m_storage[0]);
  m_last = vectorsAt(t1, m_storage[1]);
}

template <Pair pair>
const Vector* IntervalTest<pair>::vectorsAt(double t, Differences& storage) const {
  if (t == 0) return m_start.vectors;
  if (t == 1) return m_end.vectors;
  storage = blend(m_start, m_end, t);
  return storage.vectors;
}

/// Each vector moves on a straight line, so it stays on the side on which it is at both ends.
template <Pair pair>
bool IntervalTest<pair>::apartOnAnAxis() const {
  constexpr int first = Differences::kFirstBetween;
  Vector low = m_first[first].cwiseMin(m_last[first]);
  Vector high = m_first[first].cwiseMax(m_last[first]);
  for (int i = first + 1; i < Differences::kVectors; ++i) {
    low = low.cwiseMin(m_first[i]).cwiseMin(m_last[i]);
    high = high.cwiseMax(m_first[i]).cwiseMax(m_last[i]);
  }
  // A difference of two doubles never has the wrong sign, but it has an error that counts against a separation.
  if (m_whole && m_minSeparation == 0) return (low.array() > 0).any() || (high.array() < 0).any();
  for (int axis = 0; axis < 3; ++axis) {
    const double limit = 4 * kRoundoff * m_magnitude[axis] + kUnderflow + m_minSeparation * (1 + 0x1p-50);
    if (low[axis] > limit || high[axis] < -limit) return true;
  }
  return false;
}

/// The cubic's Bernstein coefficients have one sign, beyond their error: it has no root here. With a separation: the
/// volume is more than the separation times the longest normal, so the planes (vertexFace: the face's and the point's,
/// edgeEdge: those of the two lines) are farther apart than that.
template <Pair pair>
bool IntervalTest<pair>::neverCoplanar() {
  const Vector* const a = m_first;
  const Vector* const b = m_last;
  const Vector startNormal = a[1].cross(a[2]);
  const Vector mixedNormal = a[1].cross(b[2]) + b[1].cross(a[2]);
  const Vector endNormal = b[1].cross(b[2]);
  m_cubic[0] = a[0].dot(startNormal);
  m_cubic[1] = b[0].dot(startNormal) + a[0].dot(mixedNormal);
  m_cubic[2] = b[0].dot(mixedNormal) + a[0].dot(endNormal);
  m_cubic[3] = b[0].dot(endNormal);

  // No exact and no computed vector of this interval is larger: 5 u is more than kInside and this sum's own rounding.
  const Vector local = magnitude<pair>(m_first, m_last) + 5 * kRoundoff * m_magnitude;
  const double volume = local[0] * local[1] * local[2];
  const double input = (m_whole ? kAtEnds : kInside) * sumOfProducts(m_magnitude, local);
  double& outer = m_cubicLimit[0];
  double& inner = m_cubicLimit[1];
  outer = kRoundoff * (kOuterRounding * volume + kOuterInput * input) * (1 + 0x1p-20) + kUnderflow;
  inner = kRoundoff * (kInnerRounding * volume + kInnerInput * input) * (1 + 0x1p-20) + kUnderflow;
  if (m_minSeparation > 0) {
    const double clearance = m_minSeparation * normalBound() * (1 + 0x1p-20);
    outer += clearance;
    inner += 3 * clearance;
  }
  const bool positive = m_cubic[0] > outer && m_cubic[1] > inner && m_cubic[2] > inner && m_cubic[3] > outer;
  const bool negative = m_cubic[0] < -outer && m_cubic[1] < -inner && m_cubic[2] < -inner && m_cubic[3] < -outer;
  return positive || negative;
}

template <Pair pair>
bool IntervalTest<pair>::apartUntil(double fraction) const {
  return signedUntil({m_cubic[0], m_cubic[1] / 3, m_cubic[2] / 3, m_cubic[3]}, fraction);
}

template <Pair pair>
bool IntervalTest<pair>::apartInLast(double fraction) const {
  return signedUntil({m_cubic[3], m_cubic[2] / 3, m_cubic[1] / 3, m_cubic[0]}, fraction);
}

/// De Casteljau's scheme: means of what it is given, so that an error there does not grow; its own is 3 u of the
/// largest in each of three levels, and u for the division by three.
template <Pair pair>
bool IntervalTest<pair>::signedUntil(const double (&c)[4], double fraction) const {
  const double s = 1 - fraction;
  const double largest = std::max(std::max(std::abs(c[0]), std::abs(c[1])), std::max(std::abs(c[2]), std::abs(c[3])));
  const double limit = std::max(m_cubicLimit[0], m_cubicLimit[1] / 3) * (1 + 0x1p-20) + 11 * kRoundoff * largest;
  const double first[3] = {s * c[0] + fraction * c[1], s * c[1] + fraction * c[2], s * c[2] + fraction * c[3]};
  const double second[2] = {s * first[0] + fraction * first[1], s * first[1] + fraction * first[2]};
  const double third = s * second[0] + fraction * second[1];
  const double low = std::min(std::min(c[0], first[0]), std::min(second[0], third));
  const double high = std::max(std::max(c[0], first[0]), std::max(second[0], third));
  return low > limit || high < -limit;
}

/// Upper bound on the length of the normal during the interval: it is a quadratic, in the hull of its Bernstein
/// coefficients.
template <Pair pair>
double IntervalTest<pair>::normalBound() const {
  const auto edges = [](const Vector* v) {
    if constexpr (pair == Pair::vertexFace) {
      return std::make_pair(Vector(v[1] - v[0]), Vector(v[2] - v[0]));
    } else {
      return std::make_pair(v[0], Vector(v[2] - v[1]));
    }
  };
  const auto [a, b] = edges(m_first);
  const auto [c, d] = edges(m_last);
  const Vector mixed = 0.5 * (a.cross(d) + c.cross(b));
  // Each component is two products of two edges. An edge is no longer than 2 M and wrong by (2 kInside + 2) u M at
  // most, which makes 2 * 2 * 8.02 * 2 u M^2 = 64.2 u M^2; the roundings are at most 3 u of 2 * 4 M^2.
  const double largest = m_magnitude.maxCoeff();
  const double error = 100 * kRoundoff * largest * largest + kUnderflow;
  return longest(a.cross(b), mixed, c.cross(d), error);
}

/// All differences on one side of the plane through the origin with this normal, at both ends of the interval.
template <Pair pair>
bool IntervalTest<pair>::apartAlong(const Vector& direction) const {
  const Vector size = direction.cwiseAbs();
  double limit = kDot * (1 + 0x1p-20) * kRoundoff * size.dot(m_magnitude) * (1 + 0x1p-20) + kUnderflow;
  if (m_minSeparation > 0) {
    // So long that its square does not underflow; a shorter one is the zero vector, give or take rounding.
    if (!(size.maxCoeff() > 0x1p-400)) return false;
    limit += m_minSeparation * size.norm() * (1 + 0x1p-50);
  }
  double low = direction.dot(m_first[Differences::kFirstBetween]);
  double high = low;
  for (int i = Differences::kFirstBetween; i < Differences::kVectors; ++i) {
    const double first = direction.dot(m_first[i]);
    const double last = direction.dot(m_last[i]);
    low = std::min(low, std::min(first, last));
    high = std::max(high, std::max(first, last));
  }
  return low > limit || high < -limit;
}

/// The directions in which figures in a common plane are apart, if they are, taken from the middle of the interval.
/// Which ones are tried decides how often the answer is "not known", never whether it is right.
template <>
bool IntervalTest<Pair::vertexFace>::apartInPlane() const {
  Vector middle[3];
  for (int i = 0; i < 3; ++i) middle[i] = 0.5 * (m_first[i] + m_last[i]);
  const Vector edges[3] = {middle[2] - middle[1], middle[0] - middle[2], middle[1] - middle[0]};
  const Vector normal = edges[2].cross(edges[0]);
  bool inside = true;
  for (int i = 0; i < 3; ++i) {
    if (normal.dot(middle[(i + 1) % 3].cross(edges[i])) > 0) continue;
    inside = false;
    if (apartAlong(normal.cross(edges[i]))) return true;
  }
  if (inside) return apartAlong(normal);
  for (const Vector& toVertex : middle)
    if (apartAlong(toVertex)) return true;
  // A face without area: a point beside or beyond a segment.
  const auto squares = {edges[0].squaredNorm(), edges[1].squaredNorm(), edges[2].squaredNorm()};
  const auto longestEdge = std::max_element(squares.begin(), squares.end()) - squares.begin();
  const Vector& along = edges[longestEdge];
  return apartAlong(along) || apartAlong(along.cross(middle[(longestEdge + 1) % 3]).cross(along)) || apartAlong(normal);
}

template <>
bool IntervalTest<Pair::edgeEdge>::apartInPlane() const {
  Vector middle[5];
  for (int i = 0; i < 5; ++i) middle[i] = 0.5 * (m_first[i] + m_last[i]);
  const Vector& edge = middle[0];
  const Vector other = middle[2] - middle[1];
  const Vector normal = edge.cross(other);
  const double area = normal.squaredNorm();
  const auto within = [&](double parameter) { return parameter > 0 && parameter < area; };
  const bool withinEdge = within(middle[1].cross(other).dot(normal));
  const bool withinOther = within(middle[1].cross(edge).dot(normal));
  if (withinEdge && withinOther) return apartAlong(normal);
  if (!withinEdge && apartAlong(normal.cross(other))) return true;
  if (!withinOther && apartAlong(normal.cross(edge))) return true;
  for (int i = 1; i < 5; ++i)
    if (apartAlong(middle[i])) return true;
  // Parallel edges: one beyond the other's end, or beside it.
  return apartAlong(edge) || apartAlong(other) || apartAlong(edge.cross(middle[1]).cross(edge)) || apartAlong(normal);
}

template class IntervalTest<Pair::vertexFace>;
template class IntervalTest<Pair::edgeEdge>;

}  // namespace wetcloth::collision
