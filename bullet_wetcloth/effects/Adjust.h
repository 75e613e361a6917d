// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Changes some of an effect's parameters, by name, and leaves the others as they are:
///
///     adjust(wind, [](auto& air) { air.velocity = btVector3(0, 0, 2); });
///
/// Throws what the effect's setParameters() throws, and what `change` throws; nothing has changed then.
template <class E, class Change>
void adjust(E& effect, Change change) {
  typename E::Parameters parameters = effect.parameters();
  change(parameters);
  effect.setParameters(std::move(parameters));
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
