// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardPairs.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/Lanes.h"
#include "bullet_wetcloth/numerics/Quad.h"
#include "bullet_wetcloth/solver/Separation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr int kPasses = 4;
constexpr int kSlowings = 100;                // of what still violates a plane
constexpr int kSlowingsInPart = 4;            // after these, groups go as one
constexpr btScalar kReserve = btScalar(0.1);  // of the thickness, that is not used up at once
constexpr btScalar kUsed = btScalar(0.5);     // of what is left of it, in a small step
constexpr btScalar kParts = btScalar(0.05);   // of the thickness that is missing, in a small step
// In roundings of a place. A measured gap is wrong by less than 14 of them: see docs/guard.md.
constexpr btScalar kApart = 1;  // a gap that is computed in double has to be more at the end of a small step
constexpr btScalar kMeeting = btScalar(0.5);  // and when a plane is made
constexpr btScalar kSmall = 32;               // a gap does not shrink below, and is computed in double there
constexpr btScalar kNoise = 3;                // what moving two parts as one may do to a gap
constexpr btScalar kWorthParting = 128;
constexpr double kExact = 0.99;    // of a distance, that a gap along its direction has
constexpr double kOfTheWay = 0.9;  // to the least gap, when a group is slowed

void placesOf(const GuardPair& pair, const std::vector<GuardNodes::Place>& from, double (&places)[4][3]) {
  for (int node = 0; node < 4; ++node) {
    for (int k = 0; k < 3; ++k) places[node][k] = static_cast<double>(from[toSize(pair.node[node])].at[k]);
  }
}

void shift(GuardNodes::Place& place, const btVector3& by, btScalar share) {
  for (int k = 0; k < 3; ++k) place.at[k] += by[k] * share;
}

WETCLOTH_INLINE Quad along(const Quad (&a)[3], const Quad (&b)[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Four pairs at once, of which a plane across the normal of the face, or of both edges, may tell the parts apart by
// more than a distance, now and after some steps. Returns which of them it does not.
template <int first>
WETCLOTH_INLINE unsigned nearPairs(const GuardPair* pairs, const GuardNodes& nodes, int steps, btScalar distance) {
  Quad now[4][4];  // node, axis: from the first node
  Quad then[4][4];
  for (std::size_t node = 0; node < 4; ++node) {
    Quad starts[4];
    Quad ends[4];
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t i = toSize(pairs[k].node[node]);
      starts[k] = load<Quad>(nodes.from[i].at);
      ends[k] = starts[k] + everywhere<Quad>(static_cast<btScalar>(steps)) * (load<Quad>(nodes.to[i].at) - starts[k]);
    }
    transpose(starts, now[node]);
    transpose(ends, then[node]);
  }
  const auto way = [](const Quad(&at)[4][4], int from, int to, Quad(&result)[3]) {
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
  const auto widen = [&](const Quad(&at)[4][4]) {
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
  const auto isNear = !(gap * gap > everywhere<Quad>(distance * distance) * along(normal, normal));
  unsigned result = 0;
  for (unsigned k = 0; k < 4; ++k) result |= isNear[k] ? 1u << k : 0u;
  return result;
}

// How much the two places of a plane resist being moved apart: the sum of squared weights over masses [1/kg].
btScalar yieldOf(const GuardPlanes& planes, std::size_t plane, const GuardNodes& nodes) {
  btScalar sum = 0;
  for (int k = 0; k < 4; ++k) {
    const btScalar weight = planes.weight(plane, k);
    sum += weight * weight * nodes.inverseMass[toSize(planes.node(plane, k))];
  }
  return sum;
}

}  // namespace

// --- planes ---------------------------------------------------------------------------------------------------------

void GuardPairs::clear() {
  m_vertexFace.clear();
  m_edgeEdge.clear();
}

long long GuardPairs::look(const GuardNodes& nodes, const GuardCandidates& pairs,
                           const GuardTiles::Expectation& expectation, const Contact& contact) {
  m_contact = contact;
  clear();
  // Each of two nodes may leave its way by the slack on each axis.
  const btScalar slack = btScalar(2 * std::sqrt(3.0)) * expectation.slack;
  const btScalar near = reach() + slack;
  return look<1>(nodes, pairs.vertexFace, expectation.steps, near, m_vertexFace) +
         look<2>(nodes, pairs.edgeEdge, expectation.steps, near, m_edgeEdge);
}

template <int first>
long long GuardPairs::look(const GuardNodes& nodes, const std::vector<GuardPair>& pairs, int steps, btScalar near,
                           GuardPlanes& planes) {
  long long meeting = 0;
  for (std::size_t begin = 0; begin < pairs.size(); begin += 4) {
    const std::size_t count = std::min(pairs.size() - begin, std::size_t(4));
    const unsigned isNear = count < 4 ? 15 : nearPairs<first>(&pairs[begin], nodes, steps, near);
    for (std::size_t k = 0; k < count; ++k) {
      if ((isNear >> k & 1) != 0 && !addPlane<first>(nodes, pairs[begin + k], steps, near, planes)) ++meeting;
    }
  }
  return meeting;
}

// Returns false when the parts meet.
template <int first>
bool GuardPairs::addPlane(const GuardNodes& nodes, const GuardPair& pair, int steps, btScalar near,
                          GuardPlanes& planes) const {
  double places[4][3];
  double ends[4][3];
  placesOf(pair, nodes.from, places);
  placesOf(pair, nodes.to, ends);
  Separation separation = first == 1 ? separationOfVertexAndFace(places) : separationOfEdges(places);
  int low = 0, high = 0;
  const double found = gapAlong(separation.normal, places, first, low, high);
  if (first == 2 && found < kExact * separation.distance) {
    const Separation atAnEnd = separationOfEdgesAtAnEnd(places);
    if (gapAlong(atAnEnd.normal, places, first, low, high) > found) separation = atAnEnd;
  }
  GuardPlanes::Plane plane = {pair, {}, {}, 0, static_cast<btScalar>(separation.distance)};
  double normal[3];
  for (int k = 0; k < 3; ++k) {
    plane.normal[k] = static_cast<btScalar>(separation.normal[k]);
    normal[k] = static_cast<double>(plane.normal[k]);
  }
  for (int k = 0; k < 4; ++k) plane.weights[k] = static_cast<btScalar>(separation.weights[k]);
  const double gap = gapAlong(normal, places, first, low, high);
  plane.gap = static_cast<btScalar>(gap);
  if (!(plane.gap > kMeeting * m_contact.rounding)) return false;
  for (int node = 0; node < 4; ++node) {
    for (int k = 0; k < 3; ++k) ends[node][k] = places[node][k] + steps * (ends[node][k] - places[node][k]);
  }
  if (std::min(gap, gapAlong(normal, ends, first, low, high)) > static_cast<double>(near)) return true;
  planes.add(plane);
  return true;
}

// What is nearer than that is held apart, whatever the thickness.
btScalar GuardPairs::reach() const { return std::max(m_contact.thickness, kWorthParting * m_contact.rounding); }

// A gap may shrink by half in a small step, so that a normal stays known to all its digits; when little more than
// rounding is left it does not shrink.
btScalar GuardPairs::wantedGapOf(btScalar gapBefore) const {
  const btScalar shrunk = std::min(kUsed * gapBefore, kReserve * m_contact.thickness);
  return std::min(std::max(kSmall * m_contact.rounding, shrunk), gapBefore);
}

bool GuardPairs::isViolated(const GuardPlanes& planes, std::size_t plane, btScalar gap) const {
  return !(gap >= wantedGapOf(planes.gap(plane)) - kNoise * m_contact.rounding);
}

bool GuardPairs::holds(const GuardPlanes& planes, const GuardNodes& nodes) {
  std::vector<GuardPlanes::Measure>& measures = m_measures[planes.first() - 1];
  measures.clear();
  for (std::size_t begin = 0; begin < planes.size(); begin += GuardPlanes::kAtOnce) {
    measures.push_back(planes.measure(begin, nodes.to));
    for (std::size_t k = 0; k < std::min(GuardPlanes::kAtOnce, planes.size() - begin); ++k) {
      const btScalar gap = measures.back().gap[k];
      if (isViolated(planes, begin + k, gap)) return false;
      if (gap < kSmall * m_contact.rounding && !isApart(planes, begin + k, nodes)) return false;
    }
  }
  return true;
}

// Beyond any doubt, since it is computed in double.
bool GuardPairs::isApart(const GuardPlanes& planes, std::size_t plane, const GuardNodes& nodes) const {
  GuardPair pair;
  for (int k = 0; k < 4; ++k) pair.node[k] = planes.node(plane, k);
  double places[4][3];
  placesOf(pair, nodes.to, places);
  const btVector3 n = planes.normal(plane);
  const double normal[3] = {static_cast<double>(n.x()), static_cast<double>(n.y()), static_cast<double>(n.z())};
  int low = 0, high = 0;
  return gapAlong(normal, places, planes.first(), low, high) > static_cast<double>(kApart * m_contact.rounding);
}

bool GuardPairs::settle(const GuardNodes& nodes) {
  if (!holds(m_vertexFace, nodes) || !holds(m_edgeEdge, nodes)) return false;
  for (GuardPlanes* const planes : {&m_vertexFace, &m_edgeEdge}) {
    const std::vector<GuardPlanes::Measure>& measures = m_measures[planes->first() - 1];
    for (std::size_t k = 0; k < measures.size(); ++k) planes->keep(k * GuardPlanes::kAtOnce, measures[k]);
  }
  return true;
}

// --- contact --------------------------------------------------------------------------------------------------------

void GuardPairs::part(GuardNodes& nodes) const {
  part(m_vertexFace, nodes);
  part(m_edgeEdge, nodes);
}

GuardPairs::Outcome GuardPairs::enforce(GuardNodes& nodes) {
  Outcome outcome;
  bool isClear = false;
  for (int k = 0; k < kPasses && !isClear; ++k) {
    isClear = pass(m_vertexFace, nodes);
    isClear = pass(m_edgeEdge, nodes) && isClear;
  }
  m_groups.clear(nodes.to.size());
  for (int k = 0; k < kSlowings; ++k) {
    if (!slow(nodes, k)) {
      outcome.stopped = static_cast<long long>(m_groups.size());
      return outcome;
    }
  }
  outcome.stopped = static_cast<long long>(m_groups.size());
  outcome.forced = release(nodes);
  return outcome;
}

void GuardPairs::part(const GuardPlanes& planes, GuardNodes& nodes) const {
  for (std::size_t plane = 0; plane < planes.size(); ++plane) {
    const btScalar missing = reach() - planes.apart(plane);
    if (!(missing > 0)) continue;
    const btScalar wanted = std::max(kParts * missing, 2 * kNoise * m_contact.rounding);
    const btScalar way = std::min(wanted, m_contact.mostParting) - planes.nearest(plane, nodes.aside).apart;
    const btScalar yield = yieldOf(planes, plane, nodes);
    if (!(yield > 0) || !(way > 0)) continue;
    const btVector3 normal = planes.normal(plane);
    for (int k = 0; k < 4; ++k) {
      const std::size_t i = toSize(planes.node(plane, k));
      const btScalar share = way * planes.weight(plane, k) * nodes.inverseMass[i] / yield;
      shift(nodes.to[i], normal, share);
      shift(nodes.aside[i], normal, share);
    }
  }
}

// Returns whether no part had left its side before its turn.
bool GuardPairs::pass(const GuardPlanes& planes, GuardNodes& nodes) const {
  bool isClear = true;
  for (std::size_t begin = 0; begin < planes.size(); begin += GuardPlanes::kAtOnce) {
    const GuardPlanes::Measure measure = planes.measure(begin, nodes.to);
    for (std::size_t k = 0; k < std::min(GuardPlanes::kAtOnce, planes.size() - begin); ++k) {
      const std::size_t plane = begin + k;
      if (measure.apart[k] < std::min(planes.apart(plane), reach())) keepApart(planes, plane, nodes);
      if (!isViolated(planes, plane, measure.gap[k])) continue;
      isClear = false;
      keepSides(planes, plane, nodes);
    }
  }
  return isClear;
}

// Within the thickness the two places do not come nearer, and friction slows how they slide.
void GuardPairs::keepApart(const GuardPlanes& planes, std::size_t plane, GuardNodes& nodes) const {
  const btScalar missing = std::min(planes.apart(plane), reach()) - planes.nearest(plane, nodes.to).apart;
  const btScalar yield = yieldOf(planes, plane, nodes);
  if (!(missing > 0) || !(yield > 0)) return;
  const btVector3 normal = planes.normal(plane);
  btVector3 slide(0, 0, 0);
  for (int k = 0; k < 4; ++k) {
    const std::size_t i = toSize(planes.node(plane, k));
    for (int axis = 0; axis < 3; ++axis) {
      slide[axis] +=
          planes.weight(plane, k) * (nodes.to[i].at[axis] - nodes.from[i].at[axis] - nodes.aside[i].at[axis]);
    }
  }
  slide -= normal * slide.dot(normal);
  const btScalar length = slide.length();
  const btScalar held = length > 0 ? std::min(btScalar(1), m_contact.friction * missing / length) : 0;
  const btVector3 move = normal * missing - slide * held;
  for (int k = 0; k < 4; ++k) {
    const std::size_t i = toSize(planes.node(plane, k));
    shift(nodes.to[i], move, planes.weight(plane, k) * nodes.inverseMass[i] / yield);
    const int node = planes.node(plane, k);
    if (nodes.isOfBodies(node)) nodes.addRecoil(node, move * (-planes.weight(plane, k) / yield), missing);
  }
}

// Moves the two nodes that are nearest to the other side.
void GuardPairs::keepSides(const GuardPlanes& planes, std::size_t plane, GuardNodes& nodes) const {
  const GuardPlanes::Nearest nearest = planes.nearest(plane, nodes.to);
  const btScalar missing = wantedGapOf(planes.gap(plane)) - nearest.gap;
  const std::size_t a = toSize(planes.node(plane, nearest.low));
  const std::size_t b = toSize(planes.node(plane, nearest.high));
  const btScalar yield = nodes.inverseMass[a] + nodes.inverseMass[b];
  if (!(missing > 0) || !(yield > 0)) return;
  const btVector3 normal = planes.normal(plane);
  shift(nodes.to[a], normal, missing * nodes.inverseMass[a] / yield);
  shift(nodes.to[b], normal, -missing * nodes.inverseMass[b] / yield);
  const btVector3 push = normal * (missing / yield);
  if (nodes.isOfBodies(static_cast<int>(a))) nodes.addRecoil(static_cast<int>(a), -push, missing);
  if (nodes.isOfBodies(static_cast<int>(b))) nodes.addRecoil(static_cast<int>(b), push, missing);
}

// --- what is left ---------------------------------------------------------------------------------------------------

// Returns whether something violated a plane, so that groups had to be slowed; those of earlier calls stay together.
bool GuardPairs::slow(GuardNodes& nodes, int turn) {
  const bool asOne = turn >= kSlowingsInPart;  // no motion against the mean is left
  bool isViolatedAnywhere = false;
  const auto forEachViolated = [&](const auto& action) {
    for (const GuardPlanes* const planes : {&m_vertexFace, &m_edgeEdge}) {
      for (std::size_t begin = 0; begin < planes->size(); begin += GuardPlanes::kAtOnce) {
        const GuardPlanes::Measure measure = planes->measure(begin, nodes.to);
        for (std::size_t k = 0; k < std::min(GuardPlanes::kAtOnce, planes->size() - begin); ++k) {
          if (isViolated(*planes, begin + k, measure.gap[k])) action(*planes, begin + k, measure.gap[k]);
        }
      }
    }
  };
  forEachViolated([&](const GuardPlanes& planes, std::size_t plane, btScalar) {
    isViolatedAnywhere = true;
    m_groups.join(nodes, planes, plane);
  });
  if (!isViolatedAnywhere) return false;
  m_groups.measure(nodes);
  forEachViolated([&](const GuardPlanes& planes, std::size_t plane, btScalar gap) {
    const double before = static_cast<double>(planes.gap(plane));
    const double wanted = static_cast<double>(wantedGapOf(planes.gap(plane)));
    const double share = asOne ? 0 : kOfTheWay * (before - wanted) / (before - static_cast<double>(gap));
    m_groups.limit(nodes, planes, plane, std::max(share, 0.0));
  });
  m_groups.apply(nodes, asOne && turn < kSlowings / 2);
  return true;
}

// Imposed nodes that move against each other may leave no room.
long long GuardPairs::release(const GuardNodes& nodes) {
  std::size_t released = 0;
  for (GuardPlanes* const planes : {&m_vertexFace, &m_edgeEdge}) {
    released += planes->filter([&](std::size_t plane) {
      bool isImposed = false;
      for (int k = 0; k < 4; ++k) isImposed = isImposed || nodes.isImposed(planes->node(plane, k));
      return !isImposed || !isViolated(*planes, plane, planes->nearest(plane, nodes.to).gap);
    });
  }
  return static_cast<long long>(released);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
