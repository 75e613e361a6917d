// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/bullet/LaneAllocator.h"

#include <BulletSoftBody/btSoftBody.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The nodes' places, velocities and inverse masses in arrays of their own, one for each axis. Bullet's nodes are
/// several cache lines each, and a loop over them cannot work on several at once.
///
/// Each node has a slot in the arrays. Where ClothSolver steps the body, these are its arrays, in its order and with
/// its origin; otherwise slots are node numbers, and places are the world's.
///
/// Who changes velocities here says so with velocitiesChanged(). Between hold() and release() the arrays stand for the
/// nodes: they are read once, by the first who asks, and written back once, at the end; otherwise they are read each
/// time, and written back at once.
class WETCLOTH_EXPORT PackedNodes {
 public:
  /// Each array has this many elements more than there are slots, all 0, so that loops may work in blocks of this size.
  static constexpr std::size_t kPadding = 64;
  /// One number for each slot; 0 where there is no node.
  using Lane = std::vector<btScalar, LaneAllocator<btScalar>>;

  /// For the nodes of this body, which must outlive it; `deformable` in that world of Bullet.
  PackedNodes(btSoftBody& body, bool deformable) : m_body(body), m_deformable(deformable) {}
  virtual ~PackedNodes() = default;
  PackedNodes(const PackedNodes&) = delete;
  PackedNodes& operator=(const PackedNodes&) = delete;

  /// Makes room for the nodes that the body has now.
  virtual void fit();
  /// The nodes as they are now, read from the body if need be. fit() must have been called since the body changed.
  void read();
  /// Slots.
  std::size_t size() const { return m_size; }
  /// Of a node.
  std::size_t slot(std::size_t node) const { return m_slots.empty() ? node : static_cast<std::size_t>(m_slots[node]); }
  /// Tells one order of slots from another.
  unsigned long long order() const { return m_order; }
  /// What places are relative to [m].
  const btVector3& origin() const { return m_origin; }

  Lane position[3];  ///< [m]
  Lane velocity[3];  ///< [m/s]
  Lane inverseMass;  ///< [1/kg], 0 of a pinned node

  /// Velocities were changed: they must be finite, and those of pinned nodes as they were.
  void velocitiesChanged();
  /// Whether they were, and the nodes do not know yet.
  bool areAhead() const { return m_hasChanged; }
  /// From now on the arrays stand for the nodes.
  void hold() { m_isHeld = true; }
  /// Writes back what changed. From now on the nodes stand for themselves.
  void release();
  /// No effect follows in this stage: as release(), or the arrays go on standing for the nodes where the step that
  /// follows begins with them.
  virtual void keep() { release(); }

 protected:
  /// Fills the arrays from the body's nodes.
  virtual void readNodes();
  /// Gives the body's nodes the velocities in the arrays.
  virtual void writeVelocities();

  btSoftBody& m_body;                       ///< whose nodes they are
  bool m_deformable;                        ///< whether it is in that world
  std::size_t m_size = 0;                   ///< slots
  std::vector<int> m_slots;                 ///< of each node; empty: their numbers
  unsigned long long m_order = 0;           ///< see order()
  btVector3 m_origin = btVector3(0, 0, 0);  ///< see origin() [m]
  bool m_isHeld = false;                    ///< see hold()
  bool m_isRead = false;                    ///< and held ever since
  bool m_hasChanged = false;                ///< velocities, which the nodes do not know yet
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
