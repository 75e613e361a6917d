// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/LocalNodes.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/BestLanes.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
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
  const btScalar* position;
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
      const Lanes x = load<Lanes>(position + i);
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

}  // namespace

void LocalNodes::reset(const NodeSlots& slots) {
  m_slots = slots.ofNode;
  m_count = slots.count;
  m_nodeOfSlot.assign(m_count, -1);
  for (std::size_t k = 0; k < m_slots.size(); ++k) m_nodeOfSlot[toSize(m_slots[k])] = static_cast<int>(k);
  for (int axis = 0; axis < 3; ++axis) {
    for (Lane* const lane : {&m_position[axis], &m_predicted[axis], &m_velocity[axis], &m_force[axis]}) {
      lane->assign(m_count + kPadding, 0);
    }
  }
  m_inverseMass.assign(m_count + kPadding, 0);
  m_isNode.assign(m_count + kPadding, 0);
  for (const int slot : m_slots) m_isNode[toSize(slot)] = 1;
  m_found.reserve(m_count);
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
    for (const int slot : m_slots) m_position[axis][toSize(slot)] -= shift[axis];
  }
}

bool LocalNodes::read() {
  centre();
  const btSoftBody::Node* node = m_slots.empty() ? nullptr : &m_body.m_nodes[0];
  btScalar anyForce = 0;
  for (const int slotOfNode : m_slots) {
    const std::size_t slot = toSize(slotOfNode);
    for (int axis = 0; axis < 3; ++axis) {
      const btScalar place = node->m_x[axis];
      if (m_isNew || place != m_origin[axis] + m_position[axis][slot]) {
        m_position[axis][slot] = place - m_origin[axis];
      }
      m_velocity[axis][slot] = node->m_v[axis];
      m_force[axis][slot] = node->m_f[axis];
      anyForce += std::fabs(node->m_f[axis]);
    }
    m_inverseMass[slot] = node->m_im;
    ++node;
  }
  m_hasForces = anyForce != 0;
  m_isNew = false;
  m_badNode = -1;
  if (isFinite()) return true;
  findBadNode();
  m_isNew = true;
  return false;
}

bool LocalNodes::isFinite() const {
  const btScalar* arrays[10] = {m_inverseMass.data()};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    arrays[1 + axis] = m_position[axis].data();
    arrays[4 + axis] = m_velocity[axis].data();
    arrays[7 + axis] = m_force[axis].data();
  }
  btScalar sum = 0;
  runOnBestLanes(FiniteCheck{arrays, std::size_t(m_hasForces ? 10 : 7), m_count, sum});
  return sum == 0;
}

void LocalNodes::findBadNode() {
  for (std::size_t k = 0; k < m_slots.size() && m_badNode < 0; ++k) {
    const std::size_t slot = toSize(m_slots[k]);
    btScalar sum = m_inverseMass[slot];
    for (int axis = 0; axis < 3; ++axis) {
      sum += m_position[axis][slot] * 0 + m_velocity[axis][slot] * 0 + m_force[axis][slot] * 0;
    }
    if (!(sum * 0 == 0)) m_badNode = static_cast<int>(k);
  }
}

void LocalNodes::predict(btScalar dt, const btVector3& gravity, btScalar largestPush) {
  SmallStep{dt, gravity, 1, largestPush}.predict(moving());
}

void LocalNodes::predictedBounds(btVector3& least, btVector3& largest) const {
  for (int axis = 0; axis < 3; ++axis) {
    runOnBestLanes(Bounds{m_predicted[axis].data(), m_isNode.data(), m_count, least[axis], largest[axis]});
  }
  least += m_origin;
  largest += m_origin;
}

void LocalNodes::findPredictedIn(const btVector3& least, const btVector3& largest) {
  m_found.clear();
  const btScalar* const position[3] = {m_predicted[0].data(), m_predicted[1].data(), m_predicted[2].data()};
  const btVector3 low = least - m_origin;
  const btVector3 high = largest - m_origin;
  runOnBestLanes(InBox{position, m_isNode.data(), m_count, low, high, m_found});
}

btSoftBody::Node& LocalNodes::showPrediction(int slot) {
  const std::size_t s = toSize(slot);
  const int index = m_nodeOfSlot[s];
  btSoftBody::Node& node = m_body.m_nodes[index];
  node.m_q = position(s) + m_origin;
  node.m_x = btVector3(m_predicted[0][s], m_predicted[1][s], m_predicted[2][s]) + m_origin;
  m_shown.push_back(index);
  return node;
}

void LocalNodes::hidePredictions() {
  for (const int node : m_shown) m_body.m_nodes[node].m_x = m_body.m_nodes[node].m_q;
  m_shown.clear();
}

// A pinned node stays where it was put, to the last bit.
void LocalNodes::write(const Lane (&normals)[3]) {
  hidePredictions();
  btSoftBody::Node* node = m_slots.empty() ? nullptr : &m_body.m_nodes[0];
  for (const int slotOfNode : m_slots) {
    const std::size_t slot = toSize(slotOfNode);
    node->m_q = node->m_x;
    const bool rests =
        m_inverseMass[slot] == 0 && m_velocity[0][slot] == 0 && m_velocity[1][slot] == 0 && m_velocity[2][slot] == 0;
    if (!rests)
      node->m_x.setValue(m_origin.x() + m_position[0][slot], m_origin.y() + m_position[1][slot],
                         m_origin.z() + m_position[2][slot]);
    node->m_v.setValue(m_velocity[0][slot], m_velocity[1][slot], m_velocity[2][slot]);
    node->m_f.setZero();
    node->m_n.setValue(normals[0][slot], normals[1][slot], normals[2][slot]);
    ++node;
  }
}

MovingNodes LocalNodes::moving() {
  MovingNodes nodes = {};
  nodes.count = m_count;
  for (int axis = 0; axis < 3; ++axis) {
    nodes.position[axis] = m_position[axis].data();
    nodes.predicted[axis] = m_predicted[axis].data();
    nodes.velocity[axis] = m_velocity[axis].data();
    nodes.force[axis] = m_hasForces ? m_force[axis].data() : nullptr;
  }
  nodes.inverseMass = m_inverseMass.data();
  return nodes;
}

void LocalNodes::transferState(StateArchive& archive) {
  archive.value(m_isNew, m_origin, m_badNode);
  for (Lane& axis : m_position) archive.array(axis);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
