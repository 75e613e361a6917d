// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardPairs.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/Lanes.h"
#include "bullet_wetcloth/numerics/Quad.h"
#include "bullet_wetcloth/solver/PlaneMaker.h"
#include "bullet_wetcloth/solver/Separation.h"
#include "bullet_wetcloth/solver/TurnedPlane.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr int kPasses = 4;
constexpr int kSlowings = 100;                    // of what still violates a plane
constexpr int kSlowingsInPart = 4;                // after these, groups go as one
constexpr btScalar kStill = btScalar(1.0 / 256);  // of the thickness: what approaches by less needs no other pass
constexpr btScalar kReserve = btScalar(0.1);      // of the thickness, that is not used up at once
constexpr btScalar kUsed = btScalar(0.5);         // of what is left of it, in a small step
constexpr btScalar kParts = btScalar(0.05);       // of the thickness that is missing, in a small step
// In roundings of a place. A measured gap is wrong by less than 14 of them: see docs/guard.md.
constexpr btScalar kApart = 1;      // a gap that is computed in double has to be more at the end of a small step
constexpr btScalar kSmall = 32;     // a gap does not shrink below, and is computed in double there
constexpr btScalar kNoise = 3;      // what moving two parts as one may do to a gap
constexpr btScalar kMostLever = 4;  // how far a node goes for what two places are to come apart
constexpr btScalar kWorthParting = 128;
constexpr double kOfTheWay = 0.9;  // to the least gap, when a group is slowed

WETCLOTH_INLINE Quad quadOf(const btVector3& vector) { return Quad{vector.x(), vector.y(), vector.z(), 0}; }
WETCLOTH_INLINE btVector3 vectorOf(const Quad& quad) { return btVector3(quad[0], quad[1], quad[2]); }
WETCLOTH_INLINE btScalar dot(const Quad& a, const Quad& b) {
  const Quad products = a * b;
  return products[0] + products[1] + products[2];
}
WETCLOTH_INLINE Quad placeOf(const std::vector<GuardNodes::Place>& places, int node) {
  return load<Quad>(places[toSize(node)].at);
}

WETCLOTH_INLINE void shift(GuardNodes::Place& place, const Quad& by, btScalar share) {
  store(place.at, load<Quad>(place.at) + by * everywhere<Quad>(share));
}

// How much the two places of a plane yield to being moved apart: the sum of squared weights over masses [1/kg]. More is
// said where a node would have to go several times as far as they come apart: a place right beside a pinned node is to
// stay there, and not to throw the other end of an edge away.
btScalar yieldOf(const GuardPlanes& planes, std::size_t plane, const GuardNodes& nodes) {
  btScalar sum = 0;
  btScalar largest = 0;
  for (int k = 0; k < 4; ++k) {
    const btScalar weight = planes.weight(plane, k);
    const btScalar share = std::fabs(weight) * nodes.inverseMass[toSize(planes.node(plane, k))];
    sum += std::fabs(weight) * share;
    largest = std::max(largest, share);
  }
  return std::max(sum, largest / kMostLever);
}

}  // namespace

// --- planes ---------------------------------------------------------------------------------------------------------

void GuardPairs::clear() {
  m_isMeasured = false;
  m_vertexFace.clear();
  m_edgeEdge.clear();
}

long long GuardPairs::look(const GuardNodes& nodes, const GuardCandidates& pairs, const Contact& contact) {
  m_contact = contact;
  m_isMeasured = false;
  const PlaneMaker maker(nodes, {reach(), contact.rounding});
  return maker.make<1>(pairs.vertexFace, m_vertexFace) + maker.make<2>(pairs.edgeEdge, m_edgeEdge);
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

// Calls action(plane, measured gap, measured distance of the places) for the planes of a block that may be violated or
// whose places are nearer than some distance.
template <class Action>
void GuardPairs::forEachNear(std::size_t block, const GuardPlanes::Measure& measure, btScalar apart,
                             const Action& action) const {
  const btScalar mostWanted = std::max(kSmall * m_contact.rounding, kReserve * m_contact.thickness);
  unsigned near = GuardPlanes::below(measure, mostWanted, apart);
  for (std::size_t k = 0; near != 0; ++k, near >>= 1) {
    if ((near & 1) != 0) action(block * GuardPlanes::kAtOnce + k, measure.gap[k], measure.apart[k]);
  }
}

template <class Action>
void GuardPairs::forEachNear(std::size_t block, const GuardPlanes::Measure& measure, const Action& action) const {
  forEachNear(block, measure, -std::numeric_limits<btScalar>::infinity(), action);
}

bool GuardPairs::holds(GuardPlanes& planes, const GuardNodes& nodes) {
  bool isHeld = true;
  for (std::size_t block = 0; block < planes.blocks() && isHeld; ++block) {
    const GuardPlanes::Measure& measure = m_isMeasured ? planes.measured(block) : planes.measure(block, nodes.to);
    forEachNear(block, measure, [&](std::size_t plane, btScalar gap, btScalar) {
      isHeld = isHeld && !isViolated(planes, plane, gap) &&
               (gap >= kSmall * m_contact.rounding || isApart(planes, plane, nodes));
    });
  }
  return isHeld;
}

// Beyond any doubt, since it is computed in double.
bool GuardPairs::isApart(const GuardPlanes& planes, std::size_t plane, const GuardNodes& nodes) const {
  double places[4][3];
  for (int node = 0; node < 4; ++node) {
    const GuardNodes::Place& place = nodes.to[toSize(planes.node(plane, node))];
    for (int axis = 0; axis < 3; ++axis) places[node][axis] = static_cast<double>(place.at[axis]);
  }
  const btVector3 n = planes.normal(plane);
  const double normal[3] = {static_cast<double>(n.x()), static_cast<double>(n.y()), static_cast<double>(n.z())};
  int low = 0, high = 0;
  return gapAlong(normal, places, planes.first(), low, high) > static_cast<double>(kApart * m_contact.rounding);
}

bool GuardPairs::settle(const GuardNodes& nodes) {
  if (!holds(m_vertexFace, nodes) || !holds(m_edgeEdge, nodes)) return false;
  m_vertexFace.keep();
  m_edgeEdge.keep();
  m_isMeasured = false;
  return true;
}

// --- contact --------------------------------------------------------------------------------------------------------

void GuardPairs::part(GuardNodes& nodes) {
  m_isMeasured = false;
  part(m_vertexFace, nodes);
  part(m_edgeEdge, nodes);
}

GuardPairs::Outcome GuardPairs::enforce(GuardNodes& nodes) {
  Outcome outcome;
  m_isMeasured = false;
  bool isClear = false;
  bool isPulled = false;  // a stack that hangs takes all passes
  for (int k = 0; k < kPasses && !isClear; ++k) {
    const btScalar pulled = m_cling.hold(m_vertexFace, {reach(), m_contact.touching}, nodes);
    isPulled = isPulled || (k == 0 && pulled > kStill * reach());
    isClear = pass(m_vertexFace, nodes) && !isPulled;
    isClear = pass(m_edgeEdge, nodes) && isClear;
  }
  m_groups.clear(nodes.to.size());
  for (int k = 0; k < kSlowings; ++k) {
    if (!slow(nodes, k)) {
      outcome.stopped = static_cast<long long>(m_groups.members().size());
      return outcome;
    }
  }
  outcome.stopped = static_cast<long long>(m_groups.members().size());
  outcome.forced = release(nodes);
  return outcome;
}

void GuardPairs::part(const GuardPlanes& planes, GuardNodes& nodes) const {
  for (std::size_t block = 0; block < planes.blocks(); ++block) {
    forEachNear(block, planes.kept(block), reach(), [&](std::size_t plane, btScalar, btScalar apart) {
      const btScalar missing = reach() - apart;
      if (missing > 0) part(planes, plane, missing, nodes);
    });
  }
}

void GuardPairs::part(const GuardPlanes& planes, std::size_t plane, btScalar missing, GuardNodes& nodes) const {
  const btScalar wanted = std::max(kParts * missing, 2 * kNoise * m_contact.rounding);
  const btScalar way = std::min(wanted, m_contact.mostParting) - planes.nearest(plane, nodes.aside).apart;
  const btScalar yield = yieldOf(planes, plane, nodes);
  if (!(yield > 0) || !(way > 0)) return;
  const Quad normal = quadOf(planes.normal(plane));
  for (int k = 0; k < 4; ++k) {
    const std::size_t i = toSize(planes.node(plane, k));
    const btScalar share = way * planes.weight(plane, k) * nodes.inverseMass[i] / yield;
    shift(nodes.to[i], normal, share);
    shift(nodes.aside[i], normal, share);
  }
}

// Returns whether, before its turn, no part had left its side nor approached another within the thickness.
bool GuardPairs::pass(GuardPlanes& planes, GuardNodes& nodes) const {
  bool isClear = true;
  for (std::size_t block = 0; block < planes.blocks(); ++block) {
    const GuardPlanes::Measure& measure = planes.measure(block, nodes.to);
    forEachNear(block, measure, reach(), [&](std::size_t plane, btScalar gap, btScalar apart) {
      if (apart < reach() && keepApart(planes, plane, nodes) > kStill * reach()) isClear = false;
      if (!isViolated(planes, plane, gap)) return;
      isClear = false;
      keepSides(planes, plane, nodes);
    });
  }
  return isClear;
}

// Within the thickness the two places do not come nearer, but for what other pairs that part do to them, and friction
// slows how they slide. Returns by how much they would have come nearer [m].
btScalar GuardPairs::keepApart(const GuardPlanes& planes, std::size_t plane, GuardNodes& nodes) const {
  const Quad normal = quadOf(planes.normal(plane));
  Quad between = everywhere<Quad>(0);  // the two places
  Quad aside = everywhere<Quad>(0);
  const Quad origin = placeOf(nodes.to, planes.node(plane, 0));
  for (int k = 0; k < 4; ++k) {
    const Quad weight = everywhere<Quad>(planes.weight(plane, k));
    between = between + weight * (placeOf(nodes.to, planes.node(plane, k)) - origin);
    aside = aside + weight * placeOf(nodes.aside, planes.node(plane, k));
  }
  const btScalar wanted = planes.apart(plane) + dot(aside, normal);
  const btScalar missing = std::min(wanted, reach()) - dot(between, normal);
  if (!(missing > 0)) return 0;
  const btScalar yield = yieldOf(planes, plane, nodes);
  if (!(yield > 0)) return 0;
  Quad slide = -aside;
  for (int k = 0; k < 4; ++k) {
    const int node = planes.node(plane, k);
    slide = slide + everywhere<Quad>(planes.weight(plane, k)) * (placeOf(nodes.to, node) - placeOf(nodes.from, node));
  }
  slide = slide - normal * everywhere<Quad>(dot(slide, normal));
  const btScalar length = std::sqrt(dot(slide, slide));
  const btScalar held = length > 0 ? std::min(btScalar(1), frictionOf(planes, plane, nodes) * missing / length) : 0;
  const Quad move = normal * everywhere<Quad>(missing) - slide * everywhere<Quad>(held);
  for (int k = 0; k < 4; ++k) {
    const std::size_t i = toSize(planes.node(plane, k));
    shift(nodes.to[i], move, planes.weight(plane, k) * nodes.inverseMass[i] / yield);
    const int node = planes.node(plane, k);
    if (nodes.isOfBodies(node)) nodes.addRecoil(node, vectorOf(move) * (-planes.weight(plane, k) / yield), missing);
  }
  return missing;
}

// The larger one of the two sides; rigid bodies have none of their own.
btScalar GuardPairs::frictionOf(const GuardPlanes& planes, std::size_t plane, const GuardNodes& nodes) const {
  if (nodes.friction.empty()) return m_contact.friction;
  btScalar factors[2] = {0, 0};
  for (int k = 0; k < 4; ++k) {
    factors[k < planes.first() ? 0 : 1] +=
        std::fabs(planes.weight(plane, k)) * nodes.friction[toSize(planes.node(plane, k))];
  }
  return m_contact.friction * std::max(factors[0], factors[1]);
}

// Moves the two nodes that are nearest to the other side.
void GuardPairs::keepSides(const GuardPlanes& planes, std::size_t plane, GuardNodes& nodes) const {
  const GuardPlanes::Nearest nearest = planes.nearest(plane, nodes.to);
  const btScalar missing = wantedGapOf(planes.gap(plane)) - nearest.gap;
  const std::size_t a = toSize(planes.node(plane, nearest.low));
  const std::size_t b = toSize(planes.node(plane, nearest.high));
  const btScalar yield = nodes.inverseMass[a] + nodes.inverseMass[b];
  if (!(missing > 0) || !(yield > 0)) return;
  const Quad normal = quadOf(planes.normal(plane));
  shift(nodes.to[a], normal, missing * nodes.inverseMass[a] / yield);
  shift(nodes.to[b], normal, -missing * nodes.inverseMass[b] / yield);
  const btVector3 push = vectorOf(normal) * (missing / yield);
  if (nodes.isOfBodies(static_cast<int>(a))) nodes.addRecoil(static_cast<int>(a), -push, missing);
  if (nodes.isOfBodies(static_cast<int>(b))) nodes.addRecoil(static_cast<int>(b), push, missing);
}

// --- what is left ---------------------------------------------------------------------------------------------------

// Returns whether something violated a plane, so that groups had to be slowed; those of earlier calls stay together. If
// not, all planes are measured.
bool GuardPairs::slow(GuardNodes& nodes, int round) {
  const bool asOne = round >= kSlowingsInPart;  // no motion against the mean is left
  m_violated.clear();
  for (GuardPlanes* const planes : {&m_vertexFace, &m_edgeEdge}) {
    for (std::size_t block = 0; block < planes->blocks(); ++block) {
      forEachNear(block, planes->measure(block, nodes.to), [&](std::size_t plane, btScalar gap, btScalar) {
        if (isViolated(*planes, plane, gap)) m_violated.push_back({planes, plane, gap});
      });
    }
  }
  const auto end = std::remove_if(m_violated.begin(), m_violated.end(),
                                  [&](const Violation& at) { return turn(*at.planes, at.plane, nodes); });
  m_violated.erase(end, m_violated.end());
  m_isMeasured = m_violated.empty();
  if (m_isMeasured) return false;
  for (const Violation& at : m_violated) {
    m_groups.join(nodes, *at.planes, at.plane);
  }
  m_groups.measure(nodes);
  for (const Violation& at : m_violated) {
    const double before = static_cast<double>(at.planes->gap(at.plane));
    const double wanted = static_cast<double>(wantedGapOf(at.planes->gap(at.plane)));
    const double share = asOne ? 0 : kOfTheWay * (before - wanted) / (before - static_cast<double>(at.gap));
    m_groups.limit(nodes, *at.planes, at.plane, std::max(share, 0.0));
  }
  m_groups.apply(nodes, asOne && round < kSlowings / 2);
  return true;
}

// Whether another plane is between the parts. It stands there from now on.
bool GuardPairs::turn(GuardPlanes& planes, std::size_t plane, const GuardNodes& nodes) const {
  const double least = static_cast<double>(kSmall * m_contact.rounding);
  const std::optional<GuardPlanes::Plane> turned = turnedPlane(planes.pair(plane), nodes, planes.first(), least);
  if (!turned) return false;
  planes.set(plane, *turned);
  return !isViolated(planes, plane,
                     planes.measure(plane / GuardPlanes::kAtOnce, nodes.to).gap[plane % GuardPlanes::kAtOnce]);
}

// Imposed nodes that move against each other may leave no room.
long long GuardPairs::release(const GuardNodes& nodes) {
  m_isMeasured = false;
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
