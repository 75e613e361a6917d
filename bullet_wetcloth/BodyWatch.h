// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Notices that a body was cut or refined: that its nodes, links or faces changed in number. And that it entered its
/// world anew, or lost it.
class WETCLOTH_EXPORT BodyWatch {
 public:
  /// The body, as it is now; it must outlive this.
  explicit BodyWatch(const btSoftBody& body) : m_body(body) {
    remember();
    enteredAnew();
  }

  /// Whether the body has another number of nodes, links or faces than was last remembered.
  bool hasChanged() const {
    return nodesChanged() || m_body.m_links.size() != m_links || m_body.m_faces.size() != m_faces;
  }
  /// Whether it has another number of nodes.
  bool nodesChanged() const { return m_body.m_nodes.size() != m_nodes; }
  /// Whether it has another entry in the broadphase than when this was last asked.
  bool enteredAnew() {
    const btBroadphaseProxy* const proxy = m_body.getBroadphaseHandle();
    const int entry = proxy ? proxy->m_uniqueId : kNoEntry;
    const bool isNew = entry != m_entry;
    m_entry = entry;
    return isNew;
  }
  /// Whether the world that it was in was deleted: that takes its entry in the broadphase from it, and leaves it the
  /// place in the world's list, which it loses when it is taken out of a world.
  bool lostItsWorld() const { return !m_body.getBroadphaseHandle() && m_body.getWorldArrayIndex() >= 0; }
  /// As last remembered.
  int nodes() const { return m_nodes; }
  /// Takes the body as it is now for the known one.
  void remember() {
    m_nodes = m_body.m_nodes.size();
    m_links = m_body.m_links.size();
    m_faces = m_body.m_faces.size();
  }

 private:
  static constexpr int kNoEntry = -1;

  const btSoftBody& m_body;
  int m_entry = kNoEntry;
  int m_nodes = 0;
  int m_links = 0;
  int m_faces = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
