// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <array>
#include <vector>

namespace pictures {

/// What a cloth hangs from: a straight bar through pinned nodes.
struct Rod {
  Vector3 from{};
  Vector3 to{};
  float radius = 0;  ///< [m]
};

/// Finds the nodes that share a rod: all pinned ones when they lie on one line, else each group of pinned ones that
/// links connect, when it does.
class Rods {
 public:
  /// @param rest  any state of the cloth in which what lies on one line shows
  Rods(const ClothShape& shape, const ClothState& rest);

  /// The rods at a moment; each ends a little outside its nodes, and an upright one stands on the ground.
  std::vector<Rod> at(const ClothState& state, const std::vector<Ground>& grounds) const;

 private:
  std::vector<std::array<int, 2>> m_ends;  // nodes
};

}  // namespace pictures
