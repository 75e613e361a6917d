// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/water/LinkConstants.h"

#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

void LinkConstants::setStiffness(const std::vector<btScalar>& factors) {
  m_stiffness = factors;
  ++m_stiffnessRevision;
  m_areStale = true;
}

void LinkConstants::refresh() {
  write([](const btSoftBody::Node* node) { return node->m_im; });
}

void LinkConstants::refresh(const std::vector<btScalar>& inverseMasses) {
  if (m_body.m_links.size() == 0) return;
  const btSoftBody::Node* const nodes = &m_body.m_nodes[0];
  const btScalar* const inverseMass = inverseMasses.data();
  write([=](const btSoftBody::Node* node) { return inverseMass[node - nodes]; });
}

// As btSoftBody::updateLinkConstants(), bit for bit, while no link's stiffness is scaled.
template <class InverseMassOf>
void LinkConstants::write(InverseMassOf inverseMassOf) {
  ++m_refreshes;
  m_areStale = false;
  if (m_body.m_links.size() == 0) return;
  btSoftBody::Link* link = &m_body.m_links[0];
  btSoftBody::Link* const end = link + m_body.m_links.size();
  if (m_stiffness.size() != static_cast<std::size_t>(m_body.m_links.size())) {
    for (; link != end; ++link) {
      const btScalar sum = inverseMassOf(link->m_n[0]) + inverseMassOf(link->m_n[1]);
      const btScalar stiffness = link->m_material->m_kLST;
      link->m_c0 = stiffness == 1 ? sum : sum / stiffness;
    }
    return;
  }
  const btScalar* factor = m_stiffness.data();
  for (; link != end; ++link, ++factor) {
    const btScalar sum = inverseMassOf(link->m_n[0]) + inverseMassOf(link->m_n[1]);
    const btScalar stiffness = link->m_material->m_kLST;
    link->m_c0 = sum / std::min(stiffness * *factor, std::max(stiffness, btScalar(1)));
  }
}

void LinkConstants::transferState(StateArchive& archive) {
  archive.growingArray(m_stiffness);
  archive.value(m_stiffnessRevision, m_areStale, m_refreshes);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
