// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/Exposure.h"

#include "bullet_wetcloth/Require.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

double Exposure::at(std::size_t node, const btVector3& position, const btVector3& normal) const {
  if (m_function) {
    const double value = m_function(position, normal);
    return value > 0 ? (value < 1 ? value : 1) : 0;  // NaN compares false, so it counts as 0
  }
  if (isPerNode()) return node < m_perNode.size() ? m_perNode[node] : 0;
  return m_constant;
}

void Exposure::requireValid(const char* field) const {
  if (m_function) return;
  if (!isPerNode()) requireFraction(field, m_constant);
  for (std::size_t i = 0; i < m_perNode.size(); ++i) {
    requireFraction(std::string(field) + "[" + std::to_string(i) + "]", m_perNode[i]);
  }
}

void Exposure::requireSize(const char* field, std::size_t nodes) const {
  if (isPerNode() && m_perNode.size() != nodes) {
    rejectValue(std::string(field) + ".size()", m_perNode.size(),
                "the number of the body's nodes, " + std::to_string(nodes));
  }
}

void Exposure::requireSize(const char* field, std::size_t nodes, const Exposure& before) const {
  if (m_perNode.size() != before.m_perNode.size()) requireSize(field, nodes);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
