// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btVector3.h>

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

// These are compiled in the library, not where they are called: an application may be compiled with -ffast-math, for
// which every number is finite.

/// Throws std::invalid_argument with the field and the value unless it is finite and > 0.
WETCLOTH_EXPORT void requirePositive(const std::string& field, double value);

/// Throws std::invalid_argument with the field and the value unless it is finite and >= 0.
WETCLOTH_EXPORT void requireNotNegative(const std::string& field, double value);

/// Throws std::invalid_argument with the field and the value unless it is in [0, 1].
WETCLOTH_EXPORT void requireFraction(const std::string& field, double value);

/// Throws std::invalid_argument with the field and the value unless it is finite.
WETCLOTH_EXPORT void requireFinite(const std::string& field, double value);

/// The same unless it is finite as Bullet's scalar.
WETCLOTH_EXPORT void requireFiniteScalar(const std::string& field, double value);

/// Throws std::invalid_argument with the field, its axis ("field.x") and the value unless all three are finite.
WETCLOTH_EXPORT void requireFinite(const std::string& field, const btVector3& value);

/// Whether all three are.
WETCLOTH_EXPORT bool isFinite(const btVector3& v);

/// What the exception that is being handled says.
WETCLOTH_EXPORT std::string currentMessage();

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
