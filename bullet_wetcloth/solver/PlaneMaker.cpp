// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/PlaneMaker.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/Lanes.h"
#include "bullet_wetcloth/numerics/Quad.h"
#include "bullet_wetcloth/solver/QuadSeparation.h"
#include "bullet_wetcloth/solver/Separation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// In roundings of a place. A gap measured from places is wrong by less than 14 of them: see docs/guard.md.
constexpr btScalar kMeeting = btScalar(0.5);  // a gap that is computed in double has to be more
constexpr btScalar kPlain = 64;               // one that is more than that need not be
const btScalar kAcrossAxes = std::sqrt(btScalar(3));
constexpr double kDirect = 0.99;  // of a distance, that a gap along its direction has

// Places of a node: placeOf(node).
template <class PlaceOf>
void placesOf(const GuardPair& pair, const PlaceOf& placeOf, double (&places)[4][3]) {
  for (int node = 0; node < 4; ++node) {
    for (int k = 0; k < 3; ++k) places[node][k] = static_cast<double>(placeOf(pair.node[node]).at[k]);
  }
}

// By axis.
template <class PlaceOf>
WETCLOTH_INLINE void placesOf(const GuardPair* pairs, const PlaceOf& placeOf, QuadPlaces& places) {
  for (std::size_t node = 0; node < 4; ++node) {
    const Quad rows[4] = {load<Quad>(placeOf(pairs[0].node[node]).at), load<Quad>(placeOf(pairs[1].node[node]).at),
                          load<Quad>(placeOf(pairs[2].node[node]).at), load<Quad>(placeOf(pairs[3].node[node]).at)};
    transpose(rows, places[node]);
  }
}

// Of a node among all.
struct PresentPlace {
  const GuardNodes& nodes;
  WETCLOTH_INLINE const GuardNodes::Place& operator()(int node) const { return nodes.from[toSize(node)]; }
};
struct ExpectedStart {
  const GuardNodes& nodes;
  WETCLOTH_INLINE const GuardNodes::Place& operator()(int node) const { return nodes.expected[toSize(node)].start; }
};
struct ExpectedEnd {
  const GuardNodes& nodes;
  WETCLOTH_INLINE const GuardNodes::Place& operator()(int node) const { return nodes.expected[toSize(node)].end; }
};

// Where the nodes of four pairs are expected.
struct QuadExpectation {
  QuadPlaces start;  // and slack
  QuadPlaces end;

  WETCLOTH_INLINE QuadExpectation(const GuardPair* pairs, const GuardNodes& nodes) {
    placesOf(pairs, ExpectedStart{nodes}, start);
    placesOf(pairs, ExpectedEnd{nodes}, end);
  }
  // How far along any direction two parts may come nearer than they are expected: each node may be away by its slack on
  // each axis.
  template <int first>
  WETCLOTH_INLINE Quad slack() const {
    Quad most[2] = {start[0][3], start[3][3]};
    for (int node = 1; node < 3; ++node) {
      Quad& of = most[node < first ? 0 : 1];
      of = greater(start[node][3], of);
    }
    return (most[0] + most[1]) * everywhere<Quad>(kAcrossAxes);
  }
};

WETCLOTH_INLINE Quad along(const Quad (&a)[3], const Quad (&b)[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Pairs of which a plane across the normal of the face, or of both edges, tells the parts apart by more than a distance
// at both times. Many candidates are of that kind, and it takes no root and no division.
template <int first>
WETCLOTH_INLINE unsigned farPairs(const QuadPlaces& now, const QuadPlaces& then, const Quad& distance) {
  const auto way = [](const QuadPlaces& at, int from, int to, Quad(&result)[3]) {
    for (int axis = 0; axis < 3; ++axis) result[axis] = at[to][axis] - at[from][axis];
  };
  Quad u[3], v[3];
  way(now, first == 1 ? 1 : 0, first == 1 ? 2 : 1, u);
  way(now, first == 1 ? 1 : 2, 3, v);
  const Quad normal[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const Quad zero = everywhere<Quad>(0);
  // The least and the largest gap along the normal, over nodes of both parts and both times.
  Quad low = everywhere<Quad>(std::numeric_limits<btScalar>::max());
  Quad high = -low;
  const auto widen = [&](const QuadPlaces& at) {
    for (int a = 0; a < first; ++a) {
      for (int b = first; b < 4; ++b) {
        Quad between[3];
        way(at, b, a, between);
        const Quad gap = along(between, normal);
        low = choose(gap < low, gap, low);
        high = choose(gap > high, gap, high);
      }
    }
  };
  widen(now);
  widen(then);
  const Quad gap = choose(low > zero, low, choose(high < zero, -high, zero));
  return bitsOf(gap * gap > distance * distance * along(normal, normal));
}

GuardPlanes::Plane planeOf(const GuardPair& pair, const QuadSeparation& separation, std::size_t lane) {
  GuardPlanes::Plane plane = {pair, {}, {}, separation.gap[lane], separation.distance[lane]};
  for (std::size_t k = 0; k < 3; ++k) plane.normal[k] = separation.normal[k][lane];
  for (std::size_t k = 0; k < 4; ++k) plane.weights[k] = separation.weights[k][lane];
  return plane;
}

}  // namespace

template <int first>
long long PlaneMaker::make(const std::vector<GuardPair>& pairs, GuardPlanes& planes) const {
  long long meeting = 0;
  std::size_t begin = 0;
  for (; begin + 4 <= pairs.size(); begin += 4) meeting += makeFour<first>(&pairs[begin], 15, planes);
  const std::size_t left = pairs.size() - begin;
  if (left == 0) return meeting;
  GuardPair four[4];
  for (std::size_t k = 0; k < 4; ++k) four[k] = pairs[begin + std::min(k, left - 1)];
  return meeting + makeFour<first>(four, (1u << left) - 1, planes);
}

// Of four pairs those whose bit is set.
template <int first>
unsigned PlaneMaker::makeFour(const GuardPair* pairs, unsigned wanted, GuardPlanes& planes) const {
  const QuadExpectation expected(pairs, m_nodes);
  const Quad near = everywhere<Quad>(m_outlook.near) + expected.slack<first>();
  const unsigned left = wanted & ~farPairs<first>(expected.start, expected.end, near);
  if (left == 0) return 0;
  QuadPlaces now;
  placesOf(pairs, PresentPlace{m_nodes}, now);
  const QuadSeparation separation = separationOf<first>(now);
  const Quad gapAtStart = gapAlong<first>(separation.normal, expected.start);
  const Quad gapAtEnd = gapAlong<first>(separation.normal, expected.end);
  const unsigned isSure = separation.isGood & bitsOf(separation.gap > everywhere<Quad>(kPlain * m_outlook.rounding));
  const unsigned isFar = isSure & bitsOf((gapAtStart > near) & (gapAtEnd > near));
  unsigned meeting = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const unsigned bit = 1u << k;
    if ((left & ~isFar & bit) == 0) continue;
    if ((isSure & bit) != 0) {
      planes.add(planeOf(pairs[k], separation, k));
    } else if (!makeExactly<first>(pairs[k], planes)) {
      ++meeting;
    }
  }
  return meeting;
}

// In double. Returns false when the parts meet.
template <int first>
bool PlaneMaker::makeExactly(const GuardPair& pair, GuardPlanes& planes) const {
  double places[4][3];
  placesOf(pair, PresentPlace{m_nodes}, places);
  Separation separation = first == 1 ? separationOfVertexAndFace(places) : separationOfEdges(places);
  int low = 0, high = 0;
  const double found = gapAlong(separation.normal, places, first, low, high);
  if (first == 2 && found < kDirect * separation.distance) {
    const Separation atAnEnd = separationOfEdgesAtAnEnd(places);
    if (gapAlong(atAnEnd.normal, places, first, low, high) > found) separation = atAnEnd;
  }
  turnApart(places, first, separation);
  GuardPlanes::Plane plane = {pair, {}, {}, 0, static_cast<btScalar>(separation.distance)};
  double normal[3];
  for (int k = 0; k < 3; ++k) {
    plane.normal[k] = static_cast<btScalar>(separation.normal[k]);
    normal[k] = static_cast<double>(plane.normal[k]);
  }
  for (int k = 0; k < 4; ++k) plane.weights[k] = static_cast<btScalar>(separation.weights[k]);
  const double gap = gapAlong(normal, places, first, low, high);
  plane.gap = static_cast<btScalar>(gap);
  if (!(plane.gap > kMeeting * m_outlook.rounding)) return false;
  double expected[2][4][3];
  placesOf(pair, ExpectedStart{m_nodes}, expected[0]);
  placesOf(pair, ExpectedEnd{m_nodes}, expected[1]);
  const GuardPair four[4] = {pair, pair, pair, pair};
  const double near = static_cast<double>(m_outlook.near + QuadExpectation(four, m_nodes).slack<first>()[0]);
  if (std::min(gapAlong(normal, expected[0], first, low, high), gapAlong(normal, expected[1], first, low, high)) >
      near) {
    return true;
  }
  planes.add(plane);
  return true;
}

template long long PlaneMaker::make<1>(const std::vector<GuardPair>&, GuardPlanes&) const;
template long long PlaneMaker::make<2>(const std::vector<GuardPair>&, GuardPlanes&) const;

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
