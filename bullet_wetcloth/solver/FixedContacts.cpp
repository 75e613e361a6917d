// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/FixedContacts.h"

#include "bullet_wetcloth/numerics/BestLanes.h"

#include <algorithm>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

template <class Lanes>
WETCLOTH_INLINE Lanes dot(const Lanes (&a)[3], const Lanes (&b)[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

void FixedContacts::reset(std::size_t slots) {
  m_blocks.clear();
  m_blocks.reserve(slots / kLanes);
  m_size = 0;
}

// A block that has this slot's contact already, with another object, or a later one, is not added to: each block has
// one contact of a node, and a node's contacts keep their order.
void FixedContacts::add(const PlaneContact& contact, const btVector3& velocity) {
  const std::size_t first = contact.slot / kLanes * kLanes;
  if (m_size == 0 || m_blocks.back().firstSlot != first || contact.slot <= m_lastSlot) {
    Block empty = {};
    std::fill(empty.slips, empty.slips + kLanes, btScalar(1));
    empty.firstSlot = first;
    m_blocks.push_back(empty);
  }
  Block& block = m_blocks.back();
  const std::size_t lane = contact.slot - first;
  for (int axis = 0; axis < 3; ++axis) {
    block.normal[axis][lane] = contact.normal[axis];
    block.velocity[axis][lane] = velocity[axis];
  }
  block.offset[lane] = contact.offset;
  block.slips[lane] = contact.slips;
  block.recovers[lane] = contact.recovers;
  m_lastSlot = contact.slot;
  ++m_size;
}

// In a lane without a contact the normal is 0 and all slipping stays: its node moves by way - way * 1 = 0.
struct FixedContacts::Kernel {
  std::vector<Block>& blocks;
  const MovingNodes& nodes;
  btScalar h;
  btScalar margin;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    for (Block& block : blocks) {
      for (std::size_t k = 0; k < kLanes; k += kLaneCount<Lanes>) project<Lanes>(block, k);
    }
  }

  template <class Lanes>
  WETCLOTH_INLINE void project(Block& block, std::size_t k) const {
    const std::size_t i = block.firstSlot + k;
    Lanes place[3];
    Lanes normal[3];
    Lanes carried[3];
    Lanes relative[3];
    for (int axis = 0; axis < 3; ++axis) {
      place[axis] = load<Lanes>(nodes.position[axis] + i);
      normal[axis] = load<Lanes>(block.normal[axis] + k);
      carried[axis] = load<Lanes>(block.velocity[axis] + k) * everywhere<Lanes>(h);
      const Lanes displaced = place[axis] - load<Lanes>(nodes.predicted[axis] + i);
      relative[axis] = load<Lanes>(nodes.velocity[axis] + i) * everywhere<Lanes>(h) + displaced - carried[axis];
    }
    const Lanes offset = load<Lanes>(block.offset + k) - dot(carried, normal);
    store(block.offset + k, offset);
    const Lanes approach = dot(relative, normal);
    const Lanes above = dot(place, normal) + offset;
    const Lanes gap = choose(above > everywhere<Lanes>(margin), everywhere<Lanes>(margin), above);
    const Lanes recovered = gap * load<Lanes>(block.recovers + k);
    const Lanes slips = load<Lanes>(block.slips + k);
    for (int axis = 0; axis < 3; ++axis) {
      const Lanes slip = relative[axis] - normal[axis] * approach;
      const Lanes moved = relative[axis] - slip * slips + normal[axis] * recovered;
      const auto leaves = approach > everywhere<Lanes>(SIMD_EPSILON);
      store(nodes.position[axis] + i, choose(leaves, place[axis], place[axis] - moved));
    }
  }
};

void FixedContacts::project(const MovingNodes& nodes, btScalar h, btScalar margin) {
  runOnBestLanes(Kernel{m_blocks, nodes, h, margin});
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
