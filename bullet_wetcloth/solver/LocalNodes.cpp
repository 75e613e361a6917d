// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/LocalNodes.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/BestLanes.h"
#include "bullet_wetcloth/solver/Parts.h"
#include "bullet_wetcloth/solver/Prefetch.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// The sum of the arrays' elements times zero: not zero when one is not finite.
struct FiniteCheck {
  const btScalar* const* arrays;
  std::size_t arrayCount;
  std::size_t count;
  btScalar& sum;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    const Lanes zero = everywhere<Lanes>(0);
    Lanes total = zero;
    for (std::size_t k = 0; k < arrayCount; ++k) {
      for (std::size_t i = 0; i < count; i += kLaneCount<Lanes>) total = total + load<Lanes>(arrays[k] + i) * zero;
    }
    btScalar parts[kLaneCount<Lanes>];
    store(parts, total);
    for (const btScalar part : parts) sum += part;
  }
};

struct Bounds {
  const btScalar* places;
  const btScalar* isNode;
  std::size_t count;
  btScalar& least;
  btScalar& largest;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    const Lanes far = everywhere<Lanes>(std::numeric_limits<btScalar>::max());
    Lanes low = far;
    Lanes high = -far;
    for (std::size_t i = 0; i < count; i += kLaneCount<Lanes>) {
      const Lanes x = load<Lanes>(places + i);
      const auto isThere = load<Lanes>(isNode + i) > everywhere<Lanes>(0);
      low = choose(isThere & (x < low), x, low);
      high = choose(isThere & (x > high), x, high);
    }
    btScalar lows[kLaneCount<Lanes>];
    btScalar highs[kLaneCount<Lanes>];
    store(lows, low);
    store(highs, high);
    least = *std::min_element(lows, lows + kLaneCount<Lanes>);
    largest = *std::max_element(highs, highs + kLaneCount<Lanes>);
  }
};

// Which slots are in a box.
struct InBox {
  const btScalar* const* position;
  const btScalar* isNode;
  std::size_t count;
  const btVector3& least;
  const btVector3& largest;
  std::vector<int>& found;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    const Lanes one = everywhere<Lanes>(1);
    const Lanes zero = everywhere<Lanes>(0);
    for (std::size_t i = 0; i < count; i += kLaneCount<Lanes>) {
      auto isIn = load<Lanes>(isNode + i) > zero;
      for (int axis = 0; axis < 3; ++axis) {
        const Lanes x = load<Lanes>(position[axis] + i);
        isIn = isIn & (x >= everywhere<Lanes>(least[axis])) & (x <= everywhere<Lanes>(largest[axis]));
      }
      btScalar parts[kLaneCount<Lanes>];
      store(parts, choose(isIn, one, zero));
      for (std::size_t k = 0; k < kLaneCount<Lanes>; ++k) {
        if (parts[k] > 0) found.push_back(static_cast<int>(i + k));
      }
    }
  }
};

// Beyond what moving an origin may have rounded. What is nearer is nothing that cloth could be put through.
bool isElsewhere(btScalar place, btScalar kept) {
  constexpr btScalar kNear = btScalar(1e-5);  // [m]
  constexpr btScalar kRoundings = 4 * std::numeric_limits<btScalar>::epsilon();
  return !(std::fabs(place - kept) <= kNear + kRoundings * std::fabs(place));
}

}  // namespace

// Each order of slots has a number of its own, whatever body it belongs to.
void LocalNodes::reset(const NodeSlots& slots) {
  static std::atomic<unsigned long long> lastOrder{0};
  release();
  m_isHeld = true;
  if (m_order == 0 || m_slots != slots.ofNode || m_size != slots.count) m_order = ++lastOrder;
  m_slots = slots.ofNode;
  m_size = slots.count;
  m_nodeOfSlot.assign(m_size, -1);
  for (std::size_t k = 0; k < m_slots.size(); ++k) m_nodeOfSlot[toSize(m_slots[k])] = static_cast<int>(k);
  for (int axis = 0; axis < 3; ++axis) {
    for (Lane* const lane : {&position[axis], &m_predicted[axis], &velocity[axis], &m_force[axis]}) {
      lane->assign(m_size + kPadding, 0);
    }
  }
  inverseMass.assign(m_size + kPadding, 0);
  m_isNode.assign(m_size + kPadding, 0);
  for (const int slot : m_slots) m_isNode[toSize(slot)] = 1;
  m_found.reserve(m_size);
  m_shown.reserve(m_slots.size());
  m_shown.clear();
  m_isNew = true;
}

// Kept places move with the origin, which is a whole number of metres, so that this rounds nothing but the places.
void LocalNodes::centre() {
  const btVector3 middle = (m_body.m_bounds[0] + m_body.m_bounds[1]) / 2;
  const btVector3 size = m_body.m_bounds[1] - m_body.m_bounds[0];
  const btVector3 away = m_isNew ? middle : middle - m_origin;
  const btScalar near = btScalar(2) + size.length();
  if (!m_isNew && away.length() < near) return;
  if (!std::isfinite(away.length())) return;
  const btVector3 shift(std::round(away.x()), std::round(away.y()), std::round(away.z()));
  if (m_isNew) {
    m_origin = shift;
    return;
  }
  m_origin += shift;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int slot : m_slots) position[axis][toSize(slot)] -= shift[axis];
  }
}

void LocalNodes::readNodes() {
  centre();
  m_hasForces = false;
  std::atomic<bool> hasForces{false};
  std::atomic<bool> arePlaced{m_isNew};
  forEachStretch(m_slots.size(), [&](std::size_t begin, std::size_t end) {
    const Seen seen = readStretch(begin, end);
    if (seen.areForced) hasForces = true;
    if (seen.arePlaced) arePlaced = true;
  });
  m_hasForces = hasForces;
  m_arePlaced = m_arePlaced || arePlaced;
  m_isNew = false;
}

LocalNodes::Seen LocalNodes::readStretch(std::size_t begin, std::size_t end) {
  btScalar anyForce = 0;
  bool arePlaced = false;
  for (std::size_t k = begin; k < end; ++k) {
    const btSoftBody::Node& node = m_body.m_nodes[static_cast<int>(k)];
    prefetch(&node + kPrefetchedAhead, sizeof node / 2);
    const std::size_t s = toSize(m_slots[k]);
    for (int axis = 0; axis < 3; ++axis) {
      const btScalar place = node.m_x[axis];
      const btScalar kept = m_origin[axis] + position[axis][s];
      if (m_isNew || place != kept) {
        position[axis][s] = place - m_origin[axis];
        arePlaced = arePlaced || (node.m_im > 0 && isElsewhere(place, kept));
      }
      velocity[axis][s] = node.m_v[axis];
      m_force[axis][s] = node.m_f[axis];
      anyForce += std::fabs(node.m_f[axis]);
    }
    inverseMass[s] = node.m_im;
  }
  return {anyForce != 0, arePlaced};
}

void LocalNodes::writeVelocities() {
  for (std::size_t k = 0; k < m_slots.size(); ++k) {
    const std::size_t s = toSize(m_slots[k]);
    m_body.m_nodes[static_cast<int>(k)].m_v.setValue(velocity[0][s], velocity[1][s], velocity[2][s]);
  }
}

bool LocalNodes::take() {
  m_isHeld = true;
  read();
  m_isRead = m_hasChanged = false;
  m_badNode = -1;
  if (isFinite()) return true;
  findBadNode();
  m_isNew = true;
  return false;
}

bool LocalNodes::isFinite() const {
  const btScalar* arrays[10] = {inverseMass.data()};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    arrays[1 + axis] = position[axis].data();
    arrays[4 + axis] = velocity[axis].data();
    arrays[7 + axis] = m_force[axis].data();
  }
  btScalar sum = 0;
  runOnBestLanes(FiniteCheck{arrays, std::size_t(m_hasForces ? 10 : 7), m_size, sum});
  return sum == 0;
}

void LocalNodes::findBadNode() {
  for (std::size_t k = 0; k < m_slots.size() && m_badNode < 0; ++k) {
    const std::size_t slot = toSize(m_slots[k]);
    btScalar sum = inverseMass[slot];
    for (int axis = 0; axis < 3; ++axis) {
      sum += position[axis][slot] * 0 + velocity[axis][slot] * 0 + m_force[axis][slot] * 0;
    }
    if (!(sum * 0 == 0)) m_badNode = static_cast<int>(k);
  }
}

void LocalNodes::predict(btScalar dt, const btVector3& gravity, btScalar largestPush) {
  SmallStep{dt, gravity, 1, largestPush}.predict(moving());
}

void LocalNodes::predictedBounds(btVector3& least, btVector3& largest) const {
  for (int axis = 0; axis < 3; ++axis) {
    runOnBestLanes(Bounds{m_predicted[axis].data(), m_isNode.data(), m_size, least[axis], largest[axis]});
  }
  least += m_origin;
  largest += m_origin;
}

void LocalNodes::findPredictedIn(const btVector3& least, const btVector3& largest) {
  m_found.clear();
  const btScalar* const predicted[3] = {m_predicted[0].data(), m_predicted[1].data(), m_predicted[2].data()};
  const btVector3 low = least - m_origin;
  const btVector3 high = largest - m_origin;
  runOnBestLanes(InBox{predicted, m_isNode.data(), m_size, low, high, m_found});
}

btSoftBody::Node& LocalNodes::showPrediction(int slot) {
  const std::size_t s = toSize(slot);
  const int index = m_nodeOfSlot[s];
  btSoftBody::Node& node = m_body.m_nodes[index];
  node.m_q = node.m_x;
  node.m_x = btVector3(m_predicted[0][s], m_predicted[1][s], m_predicted[2][s]) + m_origin;
  m_shown.push_back(index);
  return node;
}

void LocalNodes::hidePredictions() {
  for (const int node : m_shown) m_body.m_nodes[node].m_x = m_body.m_nodes[node].m_q;
  m_shown.clear();
}

void LocalNodes::write(const Lane (&normals)[3]) {
  hidePredictions();
  forEachStretch(m_slots.size(), [&](std::size_t begin, std::size_t end) { writeStretch(normals, begin, end); });
}

// A pinned node stays where it was put, to the last bit.
void LocalNodes::writeStretch(const Lane (&normals)[3], std::size_t begin, std::size_t end) {
  for (std::size_t k = begin; k < end; ++k) {
    btSoftBody::Node& node = m_body.m_nodes[static_cast<int>(k)];
    prefetch(&node + kPrefetchedAhead, sizeof node / 2);
    const std::size_t s = toSize(m_slots[k]);
    const btVector3 v(velocity[0][s], velocity[1][s], velocity[2][s]);
    node.m_q = node.m_x;
    if (inverseMass[s] != 0 || v.length2() != 0) {
      node.m_x.setValue(m_origin.x() + position[0][s], m_origin.y() + position[1][s], m_origin.z() + position[2][s]);
    }
    node.m_v = v;
    node.m_f.setZero();
    node.m_n.setValue(normals[0][s], normals[1][s], normals[2][s]);
  }
}

MovingNodes LocalNodes::moving() {
  MovingNodes nodes = {};
  nodes.count = m_size;
  for (int axis = 0; axis < 3; ++axis) {
    nodes.position[axis] = position[axis].data();
    nodes.predicted[axis] = m_predicted[axis].data();
    nodes.velocity[axis] = velocity[axis].data();
    nodes.force[axis] = m_hasForces ? m_force[axis].data() : nullptr;
  }
  nodes.inverseMass = inverseMass.data();
  return nodes;
}

void LocalNodes::transferState(StateArchive& archive) {
  archive.value(m_isNew, m_origin, m_badNode);
  for (Lane& axis : position) archive.array(axis);
  if (archive.isRestoring()) setPlaced();
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
