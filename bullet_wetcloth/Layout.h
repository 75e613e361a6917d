// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Sizes of types that an application and the library share [bytes]. They differ where the two were compiled with
/// settings that change types, such as _GLIBCXX_DEBUG or Bullet's own macros: each would then read the other's objects
/// wrongly. kLayout has the numbers: an inline function that the library calls, too, would be one
/// of the two to the linker.
struct Layout {
  std::size_t vector;         ///< sizeof(std::vector<int>)
  std::size_t string;         ///< sizeof(std::string)
  std::size_t function;       ///< sizeof a std::function
  std::size_t softBody;       ///< sizeof(btSoftBody)
  std::size_t wetCloth;       ///< sizeof(WetCloth)
  std::size_t wetClothWorld;  ///< sizeof(WetClothWorld)
};

/// Throws std::invalid_argument naming the first type of which the application has another idea than the library.
WETCLOTH_EXPORT void requireLayout(const Layout& application, const Layout& library);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
