// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/PinnedWays.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

void PinnedWays::spread(LocalNodes& nodes, btScalar dt) {
  for (Pin& pin : m_pins) {
    pin.isMoved = false;
    if (pin.node >= nodes.nodeCount()) continue;
    const std::size_t slot = nodes.slot(toSize(pin.node));
    if (nodes.inverseMass[slot] > 0) continue;
    const btVector3 last = pin.place - nodes.origin();
    const btVector3 place(nodes.position[0][slot], nodes.position[1][slot], nodes.position[2][slot]);
    if (place == last) continue;
    pin.isMoved = true;
    pin.velocity.setValue(nodes.velocity[0][slot], nodes.velocity[1][slot], nodes.velocity[2][slot]);
    pin.aim = place + pin.velocity * dt;
    for (int axis = 0; axis < 3; ++axis) {
      nodes.position[axis][slot] = last[axis];
      nodes.velocity[axis][slot] += (place[axis] - last[axis]) / dt;
    }
  }
}

void PinnedWays::arrive(LocalNodes& nodes) const {
  for (const Pin& pin : m_pins) {
    if (!pin.isMoved) continue;
    const std::size_t slot = nodes.slot(toSize(pin.node));
    for (int axis = 0; axis < 3; ++axis) nodes.position[axis][slot] = pin.aim[axis];
  }
}

void PinnedWays::end(LocalNodes& nodes) {
  for (const Pin& pin : m_pins) {
    if (!pin.isMoved) continue;
    const std::size_t slot = nodes.slot(toSize(pin.node));
    for (int axis = 0; axis < 3; ++axis) nodes.velocity[axis][slot] = pin.velocity[axis];
  }
  m_pins.clear();
  for (int node = 0; node < nodes.nodeCount(); ++node) {
    const std::size_t slot = nodes.slot(toSize(node));
    if (nodes.inverseMass[slot] > 0) continue;
    const btVector3 place(nodes.position[0][slot], nodes.position[1][slot], nodes.position[2][slot]);
    m_pins.push_back({node, place + nodes.origin(), btVector3(0, 0, 0), btVector3(0, 0, 0), false});
  }
}

void PinnedWays::transferState(StateArchive& archive) {
  archive.growing(m_pins, [&archive](Pin& pin) { archive.value(pin.node, pin.place); });
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
