// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/audit/SmallStepRecord.h"

#include "bullet_wetcloth/state/StateArchive.h"

#include <BulletSoftBody/btSoftBody.h>

#include <cstdint>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

// Its room grows in the first substep, and is there from then on.
void SmallStepRecord::afterSmallStep(const ClothSolver::SmallStepView& view) {
  if (&view.body != &m_body) return;
  if (view.index == 0) clear();
  m_nodes = static_cast<std::size_t>(view.body.m_nodes.size());
  m_origin = view.origin;
  const std::size_t begin = m_places.size();
  m_places.resize(begin + 3 * m_nodes);
  btScalar* place = m_places.data() + begin;
  for (std::size_t node = 0; node < m_nodes; ++node) {
    for (const btScalar* const axis : view.x) *place++ = axis[view.slots[node]];
  }
}

int SmallStepRecord::count(std::size_t nodes) const {
  return nodes > 0 && nodes == m_nodes ? static_cast<int>(m_places.size() / (3 * nodes)) : 0;
}

void SmallStepRecord::transferState(StateArchive& archive) {
  std::uint64_t nodes = m_nodes;
  archive.local(nodes);
  std::vector<btScalar> places = m_places;
  places.resize(archive.count(places.size()));
  const std::size_t perStep = 3 * static_cast<std::size_t>(nodes);
  if (perStep == 0 ? !places.empty() : places.size() % perStep != 0)
    archive.fail("an audit has a part of a small step");
  for (btScalar& place : places) archive.local(place);
  archive.value(m_origin);
  if (!archive.isRestoring()) return;
  m_nodes = static_cast<std::size_t>(nodes);
  m_places = std::move(places);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
