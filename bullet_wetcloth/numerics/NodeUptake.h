// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/numerics/RoundingCarry.h"
#include "bullet_wetcloth/state/StateArchive.h"
#include "bullet_wetcloth/water/Water.h"

#include <LinearMath/btVector3.h>

#include <algorithm>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Puts water into nodes up to their capacity, and loses none of it to rounding. A member of each effect that is a
/// source.
class WETCLOTH_EXPORT NodeUptake {
 public:
  /// Nothing carried, for this many nodes.
  void reset(std::size_t nodes) { m_carry.reset(nodes); }
  /// Number of nodes.
  std::size_t size() const { return m_carry.size(); }
  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive) { m_carry.transferState(archive); }

  /// Water that the node can still take [kg]; not positive when it is full.
  double room(const Water& water, std::size_t node) const {
    return water.capacity(node) - water.held(node) - m_carry[node];
  }

  /// The node soaks up `wanted` [kg], at most its room, which the caller has asked for. Returns whether it is full.
  bool soak(Water& water, std::size_t node, double room, double wanted, const btVector3& velocity) {
    if (!(room > 0)) return true;
    const bool fills = room - wanted <= kNegligible * water.capacity(node);
    const double taken = fills ? room : wanted;
    if (!(taken > 0)) return false;
    take(water, node, taken, fills, velocity.x(), velocity.y(), velocity.z());
    return fills;
  }

  /// Water of this mass strikes the node, which takes what it has room for. Returns the rest [kg].
  double catchDrops(Water& water, std::size_t node, double mass, double vx, double vy, double vz) {
    const double free = std::max(room(water, node), 0.0);
    const double taken = std::min(mass, free);
    if (taken > 0) take(water, node, taken, taken == free, vx, vy, vz);
    return mass - taken;
  }

 private:
  void take(Water& water, std::size_t node, double taken, bool fills, double vx, double vy, double vz) {
    m_carry.pass(node, taken, [&](double portion) {
      const double before = water.held(node);
      water.absorb(node, portion, vx, vy, vz);
      return water.held(node) - before;
    });
    if (fills) m_carry.settle(node);
  }

  RoundingCarry m_carry;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
