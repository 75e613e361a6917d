// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/NamedValues.h"

#include <string>

namespace command {

enum class Precision { float32, float64 };

/// What this program's btScalar is.
#ifdef BT_USE_DOUBLE_PRECISION
inline constexpr Precision ownPrecision = Precision::float64;
#else
inline constexpr Precision ownPrecision = Precision::float32;
#endif

const NamedValues<Precision>& precisionNames();
std::string nameOf(Precision precision);

/// The precision in which a command is to run.
struct PrecisionWish {
  Precision precision = ownPrecision;
  std::string wantedBy = "";  ///< the option, or the file and JSON pointer, that says so
};

}  // namespace command
