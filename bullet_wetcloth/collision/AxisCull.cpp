// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/collision/AxisCull.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace wetcloth::collision {
namespace {

/// A point as a SIMD register of two and one number more.
struct Split {
  using Two = Eigen::Array<double, 2, 1>;
  Two xy;
  double z;

  Split(const Two& firstTwo, double third) : xy(firstTwo), z(third) {}
  explicit Split(const double (&p)[3]) : xy(Eigen::Map<const Two>(p)), z(p[2]) {}
  // A processor that takes denormals for 0 moves no coordinate past another, so the proof stands.
  explicit Split(const float (&p)[3]) : xy(double(p[0]), double(p[1])), z(double(p[2])) {}
  Split min(const Split& other) const { return {xy.min(other.xy), std::min(z, other.z)}; }
  Split max(const Split& other) const { return {xy.max(other.xy), std::max(z, other.z)}; }
  Split operator+(const Split& other) const { return {xy + other.xy, z + other.z}; }
  Split operator-(const Split& other) const { return {xy - other.xy, z - other.z}; }
};

/// The boxes of the two primitives at one time.
template <Pair pair>
struct Boxes {
  Split low[2];
  Split high[2];
  Split sum;

  Boxes(const Split& p0, const Split& p1, const Split& p2, const Split& p3)
      : low{pair == Pair::vertexFace ? p0 : p0.min(p1), pair == Pair::vertexFace ? p1.min(p2.min(p3)) : p2.min(p3)},
        high{pair == Pair::vertexFace ? p0 : p0.max(p1), pair == Pair::vertexFace ? p1.max(p2.max(p3)) : p2.max(p3)},
        sum((p0 + p1) + (p2 + p3)) {}
  template <class Scalar>
  explicit Boxes(const Scalar (&p)[4][3]) : Boxes(Split(p[0]), Split(p[1]), Split(p[2]), Split(p[3])) {}
};

}  // namespace

template <Pair pair, class Scalar>
bool apartOnAnAxis(const Query<Scalar>& query) {
  const Boxes<pair> start(query.start);
  const Boxes<pair> end(query.end);
  const Split above = (start.low[1] - start.high[0]).min(end.low[1] - end.high[0]);
  const Split below = (start.low[0] - start.high[1]).min(end.low[0] - end.high[1]);
  const Split gap = above.max(below);
  // A coordinate that is infinite or not a number makes the sum so; minimum and maximum may have lost it.
  const Split sum = start.sum + end.sum;
  return std::max(std::max(gap.xy[0], gap.xy[1]), gap.z) > 0 && std::isfinite(sum.xy[0] + sum.xy[1] + sum.z);
}

template bool apartOnAnAxis<Pair::vertexFace>(const Query<float>&);
template bool apartOnAnAxis<Pair::vertexFace>(const Query<double>&);
template bool apartOnAnAxis<Pair::edgeEdge>(const Query<float>&);
template bool apartOnAnAxis<Pair::edgeEdge>(const Query<double>&);

}  // namespace wetcloth::collision
