// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/QuadSeparation.h"

#include "bullet_wetcloth/numerics/Lanes.h"

#include <cstddef>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr btScalar kOfDistance = btScalar(0.99);  // of a distance, that a gap along its direction has
constexpr btScalar kParallel = btScalar(1e-3);    // sine of the angle between nearly parallel sides
// Of a normal's squared length. More tells that squares have underflowed.
constexpr btScalar kLengthError = 32 * std::numeric_limits<btScalar>::epsilon();

using Ways = Quad[3];

WETCLOTH_INLINE Quad dot(const Ways& a, const Ways& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
WETCLOTH_INLINE void subtract(const Quad* a, const Quad* b, Ways& result) {
  for (int k = 0; k < 3; ++k) result[k] = a[k] - b[k];
}
WETCLOTH_INLINE void cross(const Ways& a, const Ways& b, Ways& result) {
  result[0] = a[1] * b[2] - a[2] * b[1];
  result[1] = a[2] * b[0] - a[0] * b[2];
  result[2] = a[0] * b[1] - a[1] * b[0];
}
// What is not a number becomes 0: of nothing's length any share will do.
WETCLOTH_INLINE Quad inUnit(const Quad& x) { return lesser(greater(x, everywhere<Quad>(0)), everywhere<Quad>(1)); }

// The nodes of the pairs from the first one, and of two sides that a plane between the parts may hold.
struct PairSides {
  Ways at[4];
  Ways u;
  Ways v;
  Ways across;
};

template <int first>
WETCLOTH_INLINE void findSides(const QuadPlaces& nodes, PairSides& sides) {
  for (std::size_t node = 0; node < 4; ++node) subtract(nodes[node], nodes[0], sides.at[node]);
  constexpr std::size_t start = first == 1 ? 1 : 0;
  subtract(nodes[start + 1], nodes[start], sides.u);
  subtract(nodes[3], nodes[first == 1 ? 1 : 2], sides.v);
  cross(sides.u, sides.v, sides.across);
}

// These set the weights and return where the nearest places are inside both parts.

WETCLOTH_INLINE auto weighEdges(const PairSides& sides, Quad (&weights)[4]) {
  const Quad zero = everywhere<Quad>(0);
  const Quad one = everywhere<Quad>(1);
  const Quad uu = dot(sides.u, sides.u);
  const Quad vv = dot(sides.v, sides.v);
  const Quad uv = dot(sides.u, sides.v);
  const Quad ub = -dot(sides.u, sides.at[2]);
  const Quad vb = -dot(sides.v, sides.at[2]);
  Quad s = inUnit((uv * vb - vv * ub) / (uu * vv - uv * uv));
  Quad t = inUnit((uv * s + vb) / vv);
  s = inUnit((uv * t - ub) / uu);
  t = inUnit((uv * s + vb) / vv);
  weights[0] = one - s;
  weights[1] = s;
  weights[2] = t - one;
  weights[3] = -t;
  return (s > zero) & (s < one) & (t > zero) & (t < one);
}

WETCLOTH_INLINE auto weighFace(const PairSides& sides, Quad (&weights)[4]) {
  const Quad zero = everywhere<Quad>(0);
  const Quad one = everywhere<Quad>(1);
  Quad nearest2 = everywhere<Quad>(std::numeric_limits<btScalar>::max());
  weights[0] = one;
  weights[1] = weights[2] = weights[3] = zero;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const Ways& a = sides.at[k + 1];
    Ways side;
    subtract(sides.at[next + 1], a, side);
    const Quad share = inUnit(-dot(a, side) / dot(side, side));
    Ways place;
    for (int axis = 0; axis < 3; ++axis) place[axis] = a[axis] + share * side[axis];
    const Quad distance2 = dot(place, place);
    const auto isNearer = distance2 < nearest2;
    nearest2 = choose(isNearer, distance2, nearest2);
    weights[k + 1] = choose(isNearer, share - one, weights[k + 1]);
    weights[next + 1] = choose(isNearer, -share, weights[next + 1]);
    weights[(k + 2) % 3 + 1] = choose(isNearer, zero, weights[(k + 2) % 3 + 1]);
  }
  const Quad area2 = dot(sides.across, sides.across);
  Quad inner[3];
  for (std::size_t k = 0; k < 2; ++k) {
    Ways opposite;
    cross(sides.at[k + 2], sides.at[(k + 2) % 3 + 1], opposite);
    inner[k] = dot(opposite, sides.across) / area2;
  }
  inner[2] = one - inner[0] - inner[1];
  const auto isInside = (inner[0] >= zero) & (inner[1] >= zero) & (inner[2] >= zero);
  for (std::size_t k = 0; k < 3; ++k) weights[k + 1] = choose(isInside, -inner[k], weights[k + 1]);
  return isInside;
}

template <int first>
WETCLOTH_INLINE auto weigh(const PairSides& sides, Quad (&weights)[4]) {
  if constexpr (first == 1) {
    return weighFace(sides, weights);
  } else {
    return weighEdges(sides, weights);
  }
}

}  // namespace

template <int first>
QuadSeparation separationOf(const QuadPlaces& nodes) {
  PairSides sides;
  findSides<first>(nodes, sides);
  QuadSeparation result;
  const auto isInside = weigh<first>(sides, result.weights);
  Ways way;
  for (std::size_t k = 0; k < 3; ++k) {
    way[k] =
        result.weights[1] * sides.at[1][k] + result.weights[2] * sides.at[2][k] + result.weights[3] * sides.at[3][k];
  }
  const Quad one = everywhere<Quad>(1);
  result.distance = squareRoot(dot(way, way));
  const Quad across2 = dot(sides.across, sides.across);
  const Quad sides2 = dot(sides.u, sides.u) * dot(sides.v, sides.v);
  // Where the nearest places are inside both parts, the way across both is known to more digits than that between.
  const auto isAcross = isInside & (across2 > everywhere<Quad>(kParallel * kParallel) * sides2);
  const Quad scale = one / choose(isAcross, squareRoot(across2), result.distance);
  const Quad turned = choose(isAcross & (dot(sides.across, way) < everywhere<Quad>(0)), -scale, scale);
  for (std::size_t k = 0; k < 3; ++k) result.normal[k] = choose(isAcross, sides.across[k], way[k]) * turned;
  result.gap = gapAlong<first>(result.normal, nodes);
  const Quad lengthError = absolute(dot(result.normal, result.normal) - one);
  result.isGood = bitsOf((result.gap >= everywhere<Quad>(kOfDistance) * result.distance) &
                         (lengthError < everywhere<Quad>(kLengthError)));
  return result;
}

template <int first>
Quad gapAlong(const Quad (&normal)[3], const QuadPlaces& nodes) {
  Quad along[4] = {everywhere<Quad>(0)};
  for (std::size_t node = 1; node < 4; ++node) {
    Ways way;
    subtract(nodes[node], nodes[0], way);
    along[node] = dot(way, normal);
  }
  const Quad low = first == 1 ? along[0] : lesser(along[0], along[1]);
  const Quad high = greater(greater(along[first], along[2]), along[3]);
  return low - high;
}

template QuadSeparation separationOf<1>(const QuadPlaces&);
template QuadSeparation separationOf<2>(const QuadPlaces&);
template Quad gapAlong<1>(const Quad (&)[3], const QuadPlaces&);
template Quad gapAlong<2>(const Quad (&)[3], const QuadPlaces&);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
