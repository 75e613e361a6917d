// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/WetCloth.h"

namespace wetcloth_test {

/// The same cloth, whose water and weight now follow in every substep: for tests of what happens in one.
inline wetcloth::WetCloth& exactly(wetcloth::WetCloth& cloth) {
  cloth.setPace(wetcloth::WaterPace::exact());
  return cloth;
}

}  // namespace wetcloth_test
