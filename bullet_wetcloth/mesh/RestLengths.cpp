// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/mesh/RestLengths.h"

#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr int kCallsForAllLinks = 32;  // calls in which all links are looked at

// Of a length. Bullet computes lengths anew when a body first steps, which changes the last bits.
constexpr btScalar kLengthRounding = btScalar(1e-5);

bool isAnotherLength(btScalar length, btScalar known) { return std::fabs(length - known) > kLengthRounding * known; }

}  // namespace

void RestLengths::remember() {
  m_known.resize(static_cast<std::size_t>(m_body.m_links.size()));
  for (std::size_t k = 0; k < m_known.size(); ++k) m_known[k] = m_body.m_links[static_cast<int>(k)].m_rl;
  if (!m_factors.empty()) m_factors.resize(m_known.size(), 1);
}

void RestLengths::note(std::size_t link, btScalar length, double factor) {
  if (m_factors.empty()) m_factors.assign(static_cast<std::size_t>(m_body.m_links.size()), 1);
  if (link < m_factors.size()) m_factors[link] = factor;
  if (link < m_known.size()) m_known[link] = length;
}

double RestLengths::natural(std::size_t link) const {
  const double length = static_cast<double>(m_body.m_links[static_cast<int>(link)].m_rl);
  return link < m_factors.size() ? length / m_factors[link] : length;
}

bool RestLengths::haveChanged() {
  const std::size_t count = m_known.size();
  if (m_pause > 0) --m_pause;
  if (m_pause > 0 || count != static_cast<std::size_t>(m_body.m_links.size())) return false;
  const std::size_t first = m_nextLink < count ? m_nextLink : 0;
  const std::size_t end = std::min(first + count / kCallsForAllLinks + 1, count);
  m_nextLink = end;
  for (std::size_t k = first; k < end; ++k) {
    if (!isAnotherLength(m_body.m_links[static_cast<int>(k)].m_rl, m_known[k])) continue;
    m_pause = kCallsForAllLinks;
    return true;
  }
  return false;
}

void RestLengths::transferState(StateArchive& archive) {
  archive.growingArray(m_known);
  archive.growingArray(m_factors);
  archive.value(m_nextLink, m_pause);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
