// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Where each node of a body stands in the arrays of the solver.
///
/// The nodes of a grid are sorted into 16 blocks, by row and column modulo 4. Then links of one direction between two
/// blocks are two stretches of consecutive slots, in which no node comes twice: a processor works on several at once
/// without gathering, in an order that sweeps in no direction. Large grids are cut into tiles of some rows, each with
/// blocks of its own, which several threads can work on. Other meshes keep their order.
struct NodeSlots {
  /// Slots that a loop works on at once, at most: every stretch begins at a multiple of it.
  static constexpr std::size_t kLanes = 8;
  /// Rows and columns are told apart modulo this.
  static constexpr int kClasses = 4;

  /// Node k is in row k / columns and column k % columns.
  struct Grid {
    int columns;
    int rows;
    int tileRows;              ///< rows of a tile, a multiple of kClasses
    std::size_t blockColumns;  ///< columns in a block
    std::size_t blockSize;     ///< slots from one block to the next
    std::size_t tileSize;      ///< slots from one tile to the next
    std::size_t first;         ///< slot of the first block in its tile

    int tiles() const { return (rows + tileRows - 1) / tileRows; }
    int tileOf(int node) const { return node / columns / tileRows; }
  };

  std::vector<int> ofNode;   ///< slot of each node
  std::size_t count = 0;     ///< slots, a multiple of kLanes; those without a node are left alone
  std::size_t tiles = 1;     ///< of as many slots each
  std::optional<Grid> grid;  ///< when the mesh is one
};

/// Looks whether the nodes are in rows, and in which: at least nine in ten links lead at most three rows and columns
/// away.
NodeSlots findSlots(const btSoftBody& body);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
