// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btVector3.h>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Throws std::invalid_argument "field = value: must be allowed".
template <class Value>
[[noreturn]] void rejectValue(const std::string& field, const Value& value, const std::string& allowed) {
  std::ostringstream text;
  text << field << " = " << value << ": must be " << allowed;
  throw std::invalid_argument(text.str());
}

/// Throws std::invalid_argument "what: why", for what has no value worth printing.
[[noreturn]] inline void reject(const std::string& what, const std::string& why) {
  throw std::invalid_argument(what + ": " + why);
}

inline void requirePositive(const std::string& field, double value) {
  if (!(std::isfinite(value) && value > 0)) rejectValue(field, value, "finite and > 0");
}

inline void requireNotNegative(const std::string& field, double value) {
  if (!(std::isfinite(value) && value >= 0)) rejectValue(field, value, "finite and >= 0");
}

inline void requireFraction(const std::string& field, double value) {
  if (!(value >= 0 && value <= 1)) rejectValue(field, value, "in [0, 1]");
}

inline bool isFinite(const btVector3& v) {
  return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

inline void requireFinite(const std::string& field, double value) {
  if (!std::isfinite(value)) rejectValue(field, value, "finite");
}

/// Names the axis: "field.x".
inline void requireFinite(const std::string& field, const btVector3& value) {
  static const char* const axes[] = {".x", ".y", ".z"};
  for (int axis = 0; axis < 3; ++axis) requireFinite(field + axes[axis], static_cast<double>(value[axis]));
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
