// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/WindField.h"

#include "bullet_wetcloth/Require.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

bool isWind(const btVector3& velocity) {
  constexpr btScalar fastest = btScalar(WindField::fastest);
  return velocity.length2() <= fastest * fastest;  // which what is not a number is not
}

}  // namespace

btVector3 WindField::at(const btVector3& position, double time) const {
  if (!m_function) return m_constant;
  const btVector3 value = m_function(position, time);
  return isWind(value) ? value : btVector3(0, 0, 0);
}

void WindField::requireValid(const char* field) const {
  requireFinite(field, m_constant);
  if (!isWind(m_constant)) rejectValue(field, m_constant.length(), "no faster than 1e6 m/s");
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
