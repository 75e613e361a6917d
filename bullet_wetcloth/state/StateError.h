// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <stdexcept>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A saved state that is damaged, foreign or of another world, or a world whose state cannot be saved; what() names
/// what is wrong.
class WETCLOTH_EXPORT StateError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
