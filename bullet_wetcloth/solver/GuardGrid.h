// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/solver/GuardMesh.h"

#include <algorithm>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Rows and columns from the first to the last one, of nodes or of squares of a grid.
struct GridRectangle {
  int firstRow, lastRow;
  int firstColumn, lastColumn;

  /// Around two places.
  static GridRectangle around(int rowA, int columnA, int rowB, int columnB) {
    return {std::min(rowA, rowB), std::max(rowA, rowB), std::min(columnA, columnB), std::max(columnA, columnB)};
  }
  bool reachesAtMost(int rowsAndColumns) const {
    return lastRow - firstRow <= rowsAndColumns && lastColumn - firstColumn <= rowsAndColumns;
  }
};

/// The squares into which a GuardMesh that is a grid is divided: its tiles, their quarters, the quarters of these, and
/// so on down to its cells.
struct GuardGrid {
  static constexpr int kLevels = 4;
  static constexpr int kCells = kLevels - 1;  ///< the last level
  static_assert(GuardMesh::kSide == 1 << kCells);

  const GuardMesh& mesh;

  /// Cells along a side of a square.
  static constexpr int side(int level) { return GuardMesh::kSide >> level; }

  int rows(int level) const { return (mesh.rows + side(level) - 1) / side(level); }
  int columns(int level) const { return (mesh.columns + side(level) - 1) / side(level); }
  int squareAt(int level, int row, int column) const { return row * columns(level) + column; }

  int tileOf(int level, int row, int column) const { return (row >> level) * mesh.tileColumns + (column >> level); }
  int cellAt(int row, int column) const {
    constexpr int kSide = GuardMesh::kSide;
    const int width = std::min(kSide, mesh.columns - column / kSide * kSide);
    return mesh.tiles[toSize(tileOf(kCells, row, column))].cell + row % kSide * width + column % kSide;
  }
  GridRectangle tilesAround(int tileA, int tileB) const {
    const int columns = mesh.tileColumns;
    return GridRectangle::around(tileA / columns, tileA % columns, tileB / columns, tileB % columns);
  }
  /// Of a square: those at its borders are its neighbours', too.
  GridRectangle nodesOf(int level, int row, int column) const {
    const int length = side(level);
    return {row * length, std::min((row + 1) * length, mesh.rows - 1), column * length,
            std::min((column + 1) * length, mesh.columns - 1)};
  }
  /// The squares of a later level in one of an earlier level.
  GridRectangle squaresIn(int level, int row, int column, int later) const {
    const int count = 1 << (later - level);
    return {row * count, std::min((row + 1) * count, rows(later)) - 1, column * count,
            std::min((column + 1) * count, columns(later)) - 1};
  }
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
