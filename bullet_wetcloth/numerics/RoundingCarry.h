// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/state/StateArchive.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Many small portions of water would be lost to rounding against the large amount that a node holds: what was due at
/// a node but its rounded water could not show yet is carried to the node's next portion. A member of what moves water
/// into nodes, or out of them.
class WETCLOTH_EXPORT RoundingCarry {
 public:
  /// Nothing carried, for this many nodes. Allocates.
  void reset(std::size_t nodes) { m_carry.assign(nodes, 0); }
  /// Number of nodes.
  std::size_t size() const { return m_carry.size(); }

  /// What is still due at the node [kg].
  double operator[](std::size_t node) const { return m_carry[node]; }

  /// Moves `portion` [kg] and what is due: move(mass) does it, and returns by how much the node's water changed [kg].
  /// Returns that.
  template <class Move>
  double pass(std::size_t node, double portion, Move move) {
    const double due = portion + m_carry[node];
    const double moved = move(due);
    m_carry[node] = due - moved;
    return moved;
  }

  /// The node is where it was to come to, and nothing is due.
  void settle(std::size_t node) { m_carry[node] = 0; }

  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive) { archive.array(m_carry); }

 private:
  std::vector<double> m_carry;  // [kg]
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
