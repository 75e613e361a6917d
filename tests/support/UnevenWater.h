// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/WetCloth.h"

#include <vector>

namespace wetcloth_test {

/// Water [kg] that differs from node to node, up to 5 times the dry mass.
inline std::vector<double> unevenWater(const wetcloth::WetCloth& cloth) {
  std::vector<double> water;
  for (int i = 0; i < cloth.nodeCount(); ++i) water.push_back(cloth.dryMass(i) * (i % 6));
  return water;
}

/// Gives the free nodes of a body the masses that wet ones have: the dry mass plus unevenWater(). To compare with a
/// wetted body, call it before the body gets clusters, a pose or anchors.
inline void makeUnevenlyHeavy(btSoftBody& body) {
  for (int i = 0; i < body.m_nodes.size(); ++i) body.m_nodes[i].m_im /= btScalar(1 + i % 6);
  body.updateLinkConstants();
}

}  // namespace wetcloth_test
