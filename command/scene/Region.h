// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Collider.h"

#include <variant>

namespace command {

/// A part of space that tells nodes by where they are.
struct Region {
  std::variant<Box, Sphere> shape;

  bool holds(const btVector3& place) const;
};

}  // namespace command
