// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/collision/Query.h"

#include <Eigen/Geometry>

#include <cmath>

// Internal: needs Eigen, which users of the installed library need not have.

namespace wetcloth::collision {

using Vector = Eigen::Vector3d;

/// Unit roundoff of double.
constexpr double kRoundoff = 0x1p-53;

/// More than everything that underflow can do to one of the sums of IntervalTest or ContactProof, and far less than
/// anything that could be proved: at most 60 operations, each wrong by at most 2^-1022 (a flushed denormal), times what
/// it is multiplied by afterwards, at most 2^305 (a direction's component).
constexpr double kUnderflow = 0x1p-700;

/// The vectors between four points at one time. All of a query is in them, and they round better than positions: a
/// difference of two doubles has a relative error of kRoundoff, however far away the two are.
///
/// The first three: p1 - p0, p2 - p0, p3 - p0, of which the determinant is the coplanarity cubic.
/// `between`: differences between a point of one primitive and a point of the other. The two meet exactly when the
/// origin is in the convex hull of these (vertexFace) or is a bilinear mean of them (edgeEdge), so a plane that has all
/// of them on one side proves that they do not.
template <Pair pair>
struct PointDifferences;

template <>
struct PointDifferences<Pair::vertexFace> {
  static constexpr int kVectors = 3;
  static constexpr int kFirstBetween = 0;
  Vector vectors[kVectors];
};

template <>
struct PointDifferences<Pair::edgeEdge> {
  static constexpr int kVectors = 5;
  static constexpr int kFirstBetween = 1;
  Vector vectors[kVectors];  ///< p1 - p0, then between: p2 - p0, p3 - p0, p2 - p1, p3 - p1
};

template <Pair pair>
PointDifferences<pair> differences(const double (&points)[4][3]) {
  const Eigen::Map<const Vector> p0(points[0]);
  const Eigen::Map<const Vector> p1(points[1]);
  const Eigen::Map<const Vector> p2(points[2]);
  const Eigen::Map<const Vector> p3(points[3]);
  if constexpr (pair == Pair::vertexFace) {
    return {{p1 - p0, p2 - p0, p3 - p0}};
  } else {
    return {{p1 - p0, p2 - p0, p3 - p0, p2 - p1, p3 - p1}};
  }
}

/// The largest |component| on each axis, of the vectors at one time and at another.
template <Pair pair>
Vector magnitude(const Vector* first, const Vector* last) {
  Vector largest = first[0].cwiseAbs().cwiseMax(last[0].cwiseAbs());
  for (int i = 1; i < PointDifferences<pair>::kVectors; ++i)
    largest = largest.cwiseMax(first[i].cwiseAbs()).cwiseMax(last[i].cwiseAbs());
  return largest;
}

/// The vectors at time t, a multiple of 2^-52 so that 1 - t is exact.
template <Pair pair>
PointDifferences<pair> blend(const PointDifferences<pair>& start, const PointDifferences<pair>& end, double t) {
  if (t == 0) return start;
  if (t == 1) return end;
  PointDifferences<pair> result;
  for (int i = 0; i < PointDifferences<pair>::kVectors; ++i)
    result.vectors[i] = (1 - t) * start.vectors[i] + t * end.vectors[i];
  return result;
}

}  // namespace wetcloth::collision
