// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/WindField.h"

#include "bullet_wetcloth/Require.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

btVector3 WindField::at(const btVector3& position, double time) const {
  if (!m_function) return m_constant;
  const btVector3 value = m_function(position, time);
  return isFinite(value) ? value : btVector3(0, 0, 0);
}

void WindField::requireValid(const char* field) const { requireFinite(field, m_constant); }

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
