// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/LinkSaturation.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/state/StateArchive.h"
#include "bullet_wetcloth/water/Water.h"

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

double saturationOf(const Water& water, std::size_t node) { return std::min(water.saturation(node), 1.0); }

}  // namespace

void LinkSaturation::reset(const btSoftBody& body, const Water& water) {
  m_links.resize(static_cast<std::size_t>(body.m_links.size()));
  for (std::size_t k = 0; k < m_links.size(); ++k) {
    const btSoftBody::Link& link = body.m_links[static_cast<int>(k)];
    m_links[k] = {toSize(nodeIndex(body, link.m_n[0])), toSize(nodeIndex(body, link.m_n[1]))};
  }
  m_saturation.resize(water.size());
  take(water);
  m_revision = water.revision();
}

bool LinkSaturation::update(const Water& water) {
  const bool rests = water.revision() == m_revision;
  if (rests && !m_lags) return false;
  m_revision = water.revision();
  const double change = largestChange(water);
  m_lags = change > 0;
  if (change <= (rests ? 0 : m_tolerance)) return false;
  take(water);
  return true;
}

double LinkSaturation::largestChange(const Water& water) const {
  double largest = 0;
  for (std::size_t i = 0; i < m_saturation.size(); ++i) {
    largest = std::max(largest, std::fabs(saturationOf(water, i) - m_saturation[i]));
  }
  return largest;
}

void LinkSaturation::take(const Water& water) {
  for (std::size_t i = 0; i < m_saturation.size(); ++i) m_saturation[i] = saturationOf(water, i);
  m_lags = false;
}

void LinkSaturation::transferState(StateArchive& archive) {
  archive.array(m_saturation);
  archive.value(m_revision, m_lags);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
