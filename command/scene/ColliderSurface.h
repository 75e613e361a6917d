// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Collider.h"

#include <vector>

namespace command {

/// Flat pieces of a surface, each with its corners in turn, counter-clockwise seen from outside.
struct ColliderSurface {
  struct Piece {
    std::vector<btVector3> corners;  ///< three or four [m]
    std::vector<btVector3> normals;  ///< one per corner, of length 1; of what is round its own
  };
  std::vector<Piece> pieces;
};

/// As it is at rest. A plane has none.
ColliderSurface surfaceOf(const Collider& collider);
/// Of that surface [m^2].
double areaOf(const Collider& collider);

}  // namespace command
