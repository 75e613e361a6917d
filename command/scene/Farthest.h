// SPDX-License-Identifier: Zlib
#pragma once

namespace command {

/// From 0 in which all that is in a scene must stay [m]. From 5e8 m on Bullet's cells of distances to shapes have no
/// number, and it reads memory that is not its own.
constexpr double farthest = 1e8;

}  // namespace command
