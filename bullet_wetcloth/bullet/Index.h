// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Bullet counts with int, the standard library with std::size_t.
inline std::size_t index(int i) { return static_cast<std::size_t>(i); }

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
