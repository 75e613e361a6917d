// SPDX-License-Identifier: Zlib
#include "command/stability/CaseMeter.h"

#include <algorithm>
#include <cmath>

namespace stability {

void CaseMeter::compare(const char* bound, double measured, double allowed) {
  double ratio = measured == 0 ? 0 : measured / allowed;
  if (std::isnan(ratio)) ratio = HUGE_VAL;
  for (Margin& margin : m_margins) {
    if (margin.bound != bound) continue;
    margin.ratio = std::max(margin.ratio, ratio);
    return;
  }
  m_margins.push_back({bound, ratio});
}

double CaseMeter::marginOf(const std::string& bound) const {
  for (const Margin& margin : m_margins) {
    if (margin.bound == bound) return margin.ratio;
  }
  return 0;
}

const CaseMeter::Margin& CaseMeter::nearest() const {
  return *std::max_element(m_margins.begin(), m_margins.end(),
                           [](const Margin& a, const Margin& b) { return a.ratio < b.ratio; });
}

}  // namespace stability
