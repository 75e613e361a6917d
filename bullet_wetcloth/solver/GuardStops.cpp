// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardStops.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

void GuardStops::begin(std::size_t nodes, bool areSame) {
  m_inStep.assign(nodes, 0);
  if (areSame && m_time.size() == nodes) return;
  m_now.assign(nodes, 0);
  m_time.assign(nodes, 0);
  m_isAnyOn = false;
}

void GuardStops::add(const std::vector<int>& nodes) {
  for (const int node : nodes) {
    if (toSize(node) < m_now.size()) m_now[toSize(node)] = 1;
  }
  m_isAnyNow = m_isAnyNow || !nodes.empty();
}

void GuardStops::addAll(const GuardNodes& nodes) {
  for (std::size_t k = 0; k < m_now.size(); ++k) m_now[k] = nodes.isImposed(static_cast<int>(k)) ? 0 : 1;
  m_isAnyNow = true;
}

void GuardStops::endSmallStep(btScalar h, const GuardNodes& nodes, const btVector3& origin) {
  if (!m_isAnyNow && !m_isAnyOn) return;
  long long count = 0;
  btVector3 sum(0, 0, 0);
  for (std::size_t k = 0; k < m_now.size(); ++k) {
    if (m_now[k] == 0) {
      m_time[k] = 0;
      continue;
    }
    m_now[k] = 0;
    m_inStep[k] = 1;
    m_time[k] += h;
    m_longest = std::max(m_longest, static_cast<double>(m_time[k]));
    const GuardNodes::Place& place = nodes.to[k];
    sum += btVector3(place.at[0], place.at[1], place.at[2]);
    ++count;
  }
  m_isAnyOn = m_isAnyNow;
  m_isAnyNow = false;
  if (count <= m_most) return;
  m_most = count;
  m_placeOfMost = origin + sum / static_cast<btScalar>(count);
}

void GuardStops::reset() {
  m_longest = 0;
  m_most = 0;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
