// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/solver/NodeSlots.h"

#include <cstdlib>
#include <optional>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A link of a grid, from its first end: how many rows and columns away the second one is.
struct GridLink {
  int from;     ///< node
  int rows;     ///< >= 0
  int columns;  ///< > 0 when rows is 0
};

/// Ends in the same block would make a node come twice in a stretch: so links lead less far than there are classes.
constexpr int kGridReach = NodeSlots::kClasses - 1;

/// The link between two nodes of a grid with so many columns; none when it leads too far.
inline std::optional<GridLink> gridLink(int a, int b, int columns) {
  const int from = a < b ? a : b;
  const int to = a < b ? b : a;
  const GridLink link = {from, to / columns - from / columns, to % columns - from % columns};
  if (link.rows > kGridReach || std::abs(link.columns) > kGridReach || from == to) return std::nullopt;
  return link;
}

/// The slot of a node.
inline std::size_t slotInGrid(const NodeSlots::Grid& grid, int node) {
  const std::size_t classes = toSize(NodeSlots::kClasses);
  const std::size_t tile = toSize(grid.tileOf(node));
  const std::size_t row = toSize(node / grid.columns % grid.tileRows);
  const std::size_t column = toSize(node % grid.columns);
  const std::size_t block = row % classes * classes + column % classes;
  const std::size_t inBlock = row / classes * grid.blockColumns + column / classes;
  return tile * grid.tileSize + grid.first + block * grid.blockSize + inBlock;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
