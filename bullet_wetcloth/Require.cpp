// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/Require.h"

#include "bullet_wetcloth/IeeeArithmetic.h"

#include <cmath>
#include <exception>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

void requirePositive(const std::string& field, double value) {
  if (!(std::isfinite(value) && value > 0)) rejectValue(field, value, "finite and > 0");
}

void requireNotNegative(const std::string& field, double value) {
  if (!(std::isfinite(value) && value >= 0)) rejectValue(field, value, "finite and >= 0");
}

void requireFraction(const std::string& field, double value) {
  if (!(value >= 0 && value <= 1)) rejectValue(field, value, "in [0, 1]");
}

void requireFinite(const std::string& field, double value) {
  if (!std::isfinite(value)) rejectValue(field, value, "finite");
}

void requireFiniteScalar(const std::string& field, double value) {
  if (!std::isfinite(static_cast<btScalar>(value))) rejectValue(field, value, "finite as Bullet's scalar");
}

void requireFinite(const std::string& field, const btVector3& value) {
  static const char* const axes[] = {".x", ".y", ".z"};
  for (int axis = 0; axis < 3; ++axis) requireFinite(field + axes[axis], static_cast<double>(value[axis]));
}

bool isFinite(const btVector3& v) { return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z()); }

std::string currentMessage() {
  try {
    throw;
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "an exception that is no std::exception";
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
