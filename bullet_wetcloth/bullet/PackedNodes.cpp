// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/bullet/PackedNodes.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

void PackedNodes::fit() {
  m_size = static_cast<std::size_t>(m_body.m_nodes.size());
  for (int axis = 0; axis < 3; ++axis) {
    position[axis].assign(m_size + kPadding, 0);
    velocity[axis].assign(m_size + kPadding, 0);
  }
  inverseMass.assign(m_size + kPadding, 0);
  m_isRead = m_hasChanged = false;
}

void PackedNodes::read() {
  if (m_isRead) return;
  readNodes();
  m_isRead = m_isHeld;
}

void PackedNodes::readNodes() {
  const btSoftBody::Node* node = m_size > 0 ? &m_body.m_nodes[0] : nullptr;
  for (std::size_t i = 0; i < m_size; ++i, ++node) {
    for (int axis = 0; axis < 3; ++axis) {
      position[axis][i] = node->m_x[axis];
      velocity[axis][i] = node->m_v[axis];
    }
    inverseMass[i] = node->m_im;
  }
}

void PackedNodes::velocitiesChanged() {
  m_hasChanged = true;
  if (m_isHeld) return;
  writeVelocities();
  m_hasChanged = false;
}

void PackedNodes::release() {
  if (m_hasChanged) writeVelocities();
  m_isHeld = m_isRead = m_hasChanged = false;
}

// The deformable world's implicit solve starts from the velocity at the end of the last step.
void PackedNodes::writeVelocities() {
  btSoftBody::Node* node = m_size > 0 ? &m_body.m_nodes[0] : nullptr;
  for (std::size_t i = 0; i < m_size; ++i, ++node) {
    const btVector3 changed(velocity[0][i], velocity[1][i], velocity[2][i]);
    if (m_deformable) node->m_vn += changed - node->m_v;
    node->m_v = changed;
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
