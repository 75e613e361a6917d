// SPDX-License-Identifier: Zlib
#pragma once

#include <bullet_wetcloth/bullet_wetcloth.h>

namespace fit {

/// Air that takes this much water from a wet cloth, both sides together: that of Drying's defaults, with less of
/// self-cooling's share where it takes less, with wind where it takes more. What the weather was is not known from it.
/// @param rate  per area of cloth [kg/m^2/s], > 0
wetcloth::Drying::Parameters airThatDries(double rate);

}  // namespace fit
