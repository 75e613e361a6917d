// SPDX-License-Identifier: Zlib
#include "command/run/StateHash.h"

#include "bullet_wetcloth/state/StateHash.h"

#include <cstdio>

namespace command {
namespace {

/// Not its fourth number, which means nothing.
void add(wetcloth::StateHash& hash, const btVector3& vector) { hash.add(vector.m_floats, 3 * sizeof(btScalar)); }

}  // namespace

std::string stateHash(const SceneWorld& world) {
  wetcloth::StateHash hash;
  for (const btSoftBody* body : world.bodies()) {
    for (int i = 0; i < body->m_nodes.size(); ++i) {
      add(hash, body->m_nodes[i].m_x);
      add(hash, body->m_nodes[i].m_v);
    }
  }
  for (const wetcloth::WetCloth* cloth : world.cloths()) {
    for (int i = 0; i < cloth->nodeCount(); ++i) {
      const double held = cloth->held(i);
      hash.add(&held, sizeof held);
    }
  }
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash.value()));
  return text;
}

}  // namespace command
