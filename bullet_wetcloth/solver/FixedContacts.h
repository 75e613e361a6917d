// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/NodeSlots.h"
#include "bullet_wetcloth/solver/SmallStep.h"

#include <LinearMath/btVector3.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A node that touches a plane.
struct PlaneContact {
  std::size_t slot;   ///< of the node
  btVector3 normal;   ///< of length 1, away from what is touched
  btScalar offset;    ///< places in the plane, which moves with what is touched, have place . normal + offset = 0 [m]
  btScalar slips;     ///< share of the slipping that stays in a small step
  btScalar recovers;  ///< share of the depth that goes in a small step
};

/// Contacts with what no impulse moves, in blocks of consecutive slots, of which a processor projects several at once.
/// Most nodes of a cloth that lies are in contact, and slots that are not are lanes in which nothing happens.
class FixedContacts {
 public:
  /// Forgets all, and makes room for a contact in each of so many slots.
  void reset(std::size_t slots);
  /// One more, with what has this velocity in all small steps [m/s]. Those of one object come in the order of their
  /// slots: then they share blocks.
  void add(const PlaneContact& contact, const btVector3& velocity);
  std::size_t size() const { return m_size; }
  /// Moves the nodes that approach what they touch, in a small step of h [s]. A contact is as deep as the cloth's
  /// margin [m] at most.
  void project(const MovingNodes& nodes, btScalar h, btScalar margin);

 private:
  static constexpr std::size_t kLanes = NodeSlots::kLanes;
  struct alignas(kLanes * sizeof(btScalar)) Block {
    btScalar normal[3][kLanes];
    btScalar velocity[3][kLanes];
    btScalar offset[kLanes];
    btScalar slips[kLanes];
    btScalar recovers[kLanes];
    std::size_t firstSlot;
  };
  struct Kernel;

  std::vector<Block> m_blocks;
  std::size_t m_lastSlot = 0;
  std::size_t m_size = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
