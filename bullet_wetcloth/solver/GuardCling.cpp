// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardCling.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/Lanes.h"
#include "bullet_wetcloth/numerics/Quad.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Of what layers are farther apart than they lie, taken back in a small step.
constexpr btScalar kComesBack = btScalar(0.05);

WETCLOTH_INLINE Quad clingPlaceOf(const std::vector<GuardNodes::Place>& places, std::size_t node) {
  return load<Quad>(places[node].at);
}

WETCLOTH_INLINE btScalar alongWay(const Quad& a, const Quad& b) {
  const Quad products = a * b;
  return products[0] + products[1] + products[2];
}

// Of the two places of a pair: how they stand to each other, how they have moved against each other in the small step,
// both without what moved them aside, and how much they yield to a push [1/kg].
struct PairMotion {
  Quad between = everywhere<Quad>(0);
  Quad way = everywhere<Quad>(0);
  btScalar yield = 0;

  WETCLOTH_INLINE PairMotion(const GuardPlanes& planes, std::size_t plane, const GuardNodes& nodes) {
    const Quad origin = clingPlaceOf(nodes.to, toSize(planes.node(plane, 0)));
    for (int k = 0; k < 4; ++k) {
      const std::size_t node = toSize(planes.node(plane, k));
      const btScalar weight = planes.weight(plane, k);
      const Quad to = clingPlaceOf(nodes.to, node) - clingPlaceOf(nodes.aside, node);
      between = between + everywhere<Quad>(weight) * (to - origin);
      way = way + everywhere<Quad>(weight) * (to - clingPlaceOf(nodes.from, node));
      yield += weight * weight * nodes.inverseMass[node];
    }
  }
};

// How much of a way is taken back by no more than what is left, which gets less [m].
btScalar spend(btScalar way, btScalar yield, btScalar& left) {
  const btScalar push = std::min(way / yield, left);
  left -= push;
  return push * yield;
}

}  // namespace

void GuardCling::begin(std::size_t nodes) {
  m_nodes = nodes;
  m_limits.clear();
}

void GuardCling::add(std::size_t firstNode, std::size_t count, const LayerWetness& wetness, btScalar h) {
  if (wetness.pull.size() != count || wetness.shear.size() != count) return;
  m_limits.resize(m_nodes);
  for (std::size_t k = 0; k < count; ++k) m_limits[firstNode + k] = {wetness.pull[k] * h * h, wetness.shear[k] * h * h};
}

void GuardCling::renew() {
  m_left.resize(m_limits.size());
  for (std::size_t k = 0; k < m_limits.size(); ++k) m_left[k] = {{m_limits[k], m_limits[k]}, btVector3(0, 0, 0)};
}

GuardCling::Limit& GuardCling::leftOn(std::size_t node, const btVector3& normal) {
  Left& left = m_left[node];
  if (left.side.isZero()) left.side = normal;
  return left.of[normal.dot(left.side) >= 0 ? 0 : 1];
}

btScalar GuardCling::hold(const GuardPlanes& vertexFace, const Range& range, GuardNodes& nodes) {
  if (isEmpty()) return 0;
  constexpr btScalar kAnyGap = -std::numeric_limits<btScalar>::infinity();
  btScalar farthest = 0;
  for (std::size_t block = 0; block < vertexFace.blocks(); ++block) {
    unsigned near = GuardPlanes::below(vertexFace.kept(block), kAnyGap, range.touching);
    for (std::size_t plane = block * GuardPlanes::kAtOnce; near != 0; ++plane, near >>= 1) {
      const bool isOfBodies =
          nodes.isOfBodies(vertexFace.node(plane, 0)) || nodes.isOfBodies(vertexFace.node(plane, 1));
      if ((near & 1) != 0 && !isOfBodies) farthest = std::max(farthest, hold(vertexFace, plane, range, nodes));
    }
  }
  return farthest;
}

btScalar GuardCling::hold(const GuardPlanes& planes, std::size_t plane, const Range& range, GuardNodes& nodes) {
  const std::size_t vertex = toSize(planes.node(plane, 0));
  const btVector3 normal = planes.normal(plane);
  Limit& left = leftOn(vertex, normal);
  if (!(left.pull > 0) && !(left.shear > 0)) return 0;
  const PairMotion motion(planes, plane, nodes);
  if (!(motion.yield > 0)) return 0;
  const btScalar before = planes.apart(plane);
  const btScalar wanted = before - kComesBack * std::max(before - range.thickness, btScalar(0));
  const Quad away = Quad{normal.x(), normal.y(), normal.z(), 0};
  const btScalar parted = std::max(alongWay(motion.between, away) - wanted, btScalar(0));
  const Quad slide = motion.way - away * everywhere<Quad>(alongWay(motion.way, away));
  const btScalar slid = std::sqrt(alongWay(slide, slide));
  const btScalar pulled = spend(parted, motion.yield, left.pull);
  const btScalar held = spend(slid, motion.yield, left.shear);
  const Quad back = away * everywhere<Quad>(pulled) + slide * everywhere<Quad>(slid > 0 ? held / slid : 0);
  for (int k = 0; k < 4; ++k) {
    const std::size_t node = toSize(planes.node(plane, k));
    const btScalar share = planes.weight(plane, k) * nodes.inverseMass[node] / motion.yield;
    store(nodes.to[node].at, load<Quad>(nodes.to[node].at) - back * everywhere<Quad>(share));
  }
  return pulled;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
