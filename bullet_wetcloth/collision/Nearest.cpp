// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/collision/Nearest.h"

#include <algorithm>

namespace wetcloth::collision {
namespace {

/// Parameter in [0, 1] of the point on the segment a-b that is nearest to `point`.
double onSegment(const Vector& a, const Vector& b, const Vector& point) {
  const Vector along = b - a;
  const double square = along.squaredNorm();
  return square > 0 ? std::clamp((point - a).dot(along) / square, 0.0, 1.0) : 0;
}

Vector between(const Vector& a, const Vector& b, double t) { return a + t * (b - a); }

/// The nearest of some candidates: which of them is right depends on signs that rounding can turn, so all are tried.
struct Best {
  double square = INFINITY;
  std::array<double, 2> where = {0, 0};

  void offer(const Vector& difference, double first, double second) {
    const double candidate = difference.squaredNorm();
    if (!(candidate < square)) return;  // also not when it is not a number
    square = candidate;
    where = {first, second};
  }
};

/// Whether a normal is long enough, for figures of this size, that rounding does not turn it: it moves the normal by
/// about 1e-16 of the squared size.
bool isSharp(const Vector& normal, double squaredSize) {
  return normal.squaredNorm() > 1e-8 * squaredSize * squaredSize;
}

}  // namespace

template <>
std::array<double, 2> nearest(const PointDifferences<Pair::vertexFace>& at) {
  const Vector(&v)[3] = at.vectors;  // the corners, seen from the point
  const Vector a = v[1] - v[0];
  const Vector b = v[2] - v[0];
  const Vector normal = a.cross(b);
  const double area = normal.squaredNorm();
  const double second = v[2].cross(v[0]).dot(normal) / area;
  const double third = v[0].cross(v[1]).dot(normal) / area;
  const bool inside = second >= 0 && third >= 0 && second + third <= 1;
  if (inside && isSharp(normal, std::max({v[0].squaredNorm(), v[1].squaredNorm(), v[2].squaredNorm()})))
    return {second, third};

  const Vector origin = Vector::Zero();
  Best best;
  if (inside) best.offer(v[0] + second * a + third * b, second, third);
  const double t = onSegment(v[0], v[1], origin);
  best.offer(between(v[0], v[1], t), t, 0);
  const double s = onSegment(v[0], v[2], origin);
  best.offer(between(v[0], v[2], s), 0, s);
  const double r = onSegment(v[1], v[2], origin);
  best.offer(between(v[1], v[2], r), 1 - r, r);
  return best.where;
}

template <>
std::array<double, 2> nearest(const PointDifferences<Pair::edgeEdge>& at) {
  const Vector(&v)[5] = at.vectors;
  // Seen from p0: p1, p2 and p3.
  const Vector p0 = Vector::Zero();
  const Vector& p1 = v[0];
  const Vector& p2 = v[1];
  const Vector& p3 = v[2];
  const Vector other = p3 - p2;
  const Vector normal = p1.cross(other);
  const double area = normal.squaredNorm();
  const double first = p2.cross(other).dot(normal) / area;
  const double second = p2.cross(p1).dot(normal) / area;
  const bool inside = first >= 0 && first <= 1 && second >= 0 && second <= 1;
  if (inside && isSharp(normal, std::max({p1.squaredNorm(), p2.squaredNorm(), p3.squaredNorm()})))
    return {first, second};

  Best best;
  const auto offerFirst = [&](double onFirst) {
    const double onSecond = onSegment(p2, p3, onFirst * p1);
    best.offer(between(p2, p3, onSecond) - onFirst * p1, onFirst, onSecond);
  };
  offerFirst(0);
  offerFirst(1);
  offerFirst(onSegment(p0, p1, p2));
  offerFirst(onSegment(p0, p1, p3));
  if (first >= 0 && first <= 1) offerFirst(first);
  return best.where;
}

}  // namespace wetcloth::collision
