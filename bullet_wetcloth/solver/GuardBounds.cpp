// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardBounds.h"

#include "bullet_wetcloth/numerics/BestLanes.h"
#include "bullet_wetcloth/solver/PatchBounds.h"

#include <algorithm>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Patches that tell whether it pays to try the others.
constexpr std::size_t kTriedFirst = 8;

constexpr std::size_t kNumbersOfWay = sizeof(GuardNodes::Way) / sizeof(btScalar);

// Between which places a row of nodes after the other starts and ends, and between which vectors those along rows and
// columns do. The last number of a place is its slack.
struct Surround {
  const GuardNodes::Way* first;
  int rows;
  int columns;
  int stride;
  btScalar (*low)[kNumbersOfWay];  // of places, along rows, along columns
  btScalar (*high)[kNumbersOfWay];

  template <class Lanes>
  struct Range {
    Lanes low = everywhere<Lanes>(std::numeric_limits<btScalar>::infinity());
    Lanes high = everywhere<Lanes>(-std::numeric_limits<btScalar>::infinity());
    WETCLOTH_INLINE void include(const Lanes& x) {
      low = lesser(x, low);
      high = greater(x, high);
    }
  };

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    for (std::size_t part = 0; part < kNumbersOfWay; part += kLaneCount<Lanes>) {
      Range<Lanes> places, alongRows, alongColumns;
      for (int row = 0; row < rows; ++row) {
        const btScalar* const at = first[toSize(row) * toSize(stride)].start.at + part;
        const btScalar* const below = at + (row + 1 < rows ? toSize(stride) * kNumbersOfWay : 0);
        Lanes here = load<Lanes>(at);
        for (std::size_t column = 0; column < toSize(columns) * kNumbersOfWay; column += kNumbersOfWay) {
          places.include(here);
          if (below != at) alongColumns.include(load<Lanes>(below + column) - here);
          if (column + kNumbersOfWay == toSize(columns) * kNumbersOfWay) break;
          const Lanes next = load<Lanes>(at + column + kNumbersOfWay);
          alongRows.include(next - here);
          here = next;
        }
      }
      store(low[0] + part, places.low);
      store(high[0] + part, places.high);
      store(low[1] + part, alongRows.low);
      store(high[1] + part, alongRows.high);
      store(low[2] + part, alongColumns.low);
      store(high[2] + part, alongColumns.high);
    }
  }
};

// Of starts and ends, and what is within so much of them.
GuardBox boxAround(const btScalar (&low)[kNumbersOfWay], const btScalar (&high)[kNumbersOfWay], btScalar slack) {
  GuardBox box;
  box.low = lesser(load<Quad>(low), load<Quad>(low + 4));
  box.high = greater(load<Quad>(high), load<Quad>(high + 4));
  box.grow(slack);
  return box;
}

// Rows or columns of a mesh that is no grid are none.
int squaresOf(const GuardMesh& mesh, int level) {
  const GuardGrid grid = {mesh};
  if (mesh.isGrid()) return grid.rows(level) * grid.columns(level);
  return level == 0 ? static_cast<int>(mesh.tiles.size()) : 0;
}

// What is there already is kept.
template <class Elements>
void growTo(std::size_t size, Elements& elements) {
  if (elements.size() < size) elements.resize(size);
}

}  // namespace

void GuardBounds::clear() {
  m_cloths.clear();
  m_patchesPay.clear();
  m_parts.clear();
  m_isAnyMesh = false;
  m_end = {};
}

void GuardBounds::add(const GuardMesh& mesh, std::size_t firstNode) {
  Cloth cloth = m_end;
  cloth.mesh = &mesh;
  cloth.firstNode = static_cast<int>(firstNode);
  cloth.nodeCount = static_cast<int>(mesh.firstTileOfNode.size());
  m_cloths.push_back(cloth);
  m_patchesPay.push_back(0);
  m_parts.add(mesh, cloth.firstNode);
  m_isAnyMesh = m_isAnyMesh || !mesh.isGrid();
  for (int k = 0; k < GuardGrid::kLevels; ++k) {
    Level& level = m_levels[k];
    m_end.firstSquare[k] += toSize(squaresOf(mesh, k));
    growTo(m_end.firstSquare[k], level.squares);
    growTo(m_end.firstSquare[k], level.isBound);
    growTo(m_end.firstSquare[k], level.four);
  }
  growTo(m_end.firstSquare[0], m_normals);
  growTo(m_end.firstSquare[0], m_normalsAreBound);
  m_end.firstPatch += mesh.patches.size();
  growTo(m_end.firstPatch, m_patches);
  m_end.firstCell += mesh.cells.size();
  m_end.firstEdge += mesh.edges.size();
  m_end.firstFace += mesh.faces.size();
  growTo(m_end.firstCell, m_partsAreBound);
  growTo(m_end.firstEdge, m_edges);
  growTo(m_end.firstFace, m_faces);
}

void GuardBounds::boundTiles(const GuardNodes& nodes, btScalar near) {
  m_nodes = &nodes;
  m_near = near;
  if (m_isAnyMesh) m_parts.begin(nodes, near);
  for (Level& level : m_levels) {
    std::fill(level.isBound.begin(), level.isBound.end(), static_cast<unsigned char>(0));
    std::fill(level.four.begin(), level.four.end(), Flatness::unknown);
  }
  std::fill(m_normalsAreBound.begin(), m_normalsAreBound.end(), static_cast<unsigned char>(0));
  std::fill(m_patches.begin(), m_patches.end(), Flatness::unknown);
  m_stirred.clear();
  m_lost.clear();
  std::fill(m_partsAreBound.begin(), m_partsAreBound.end(), static_cast<unsigned char>(0));
  for (const Cloth& cloth : m_cloths) {
    for (std::size_t tile = 0; tile < cloth.mesh->tiles.size(); ++tile) findTile(cloth, static_cast<int>(tile));
    m_patchesPay[indexOf(cloth)] = doPatchesPay(cloth);
  }
}

void GuardBounds::boundTile(const Cloth& cloth, int tile) {
  const GuardMesh& mesh = *cloth.mesh;
  findTile(cloth, tile);
  for (int cell = mesh.tiles[toSize(tile)].cell; cell < mesh.tiles[toSize(tile)].endCell; ++cell) {
    m_partsAreBound[cloth.firstCell + toSize(cell)] = 0;
  }
  if (mesh.isGrid()) return forgetSquaresOf(cloth, tile);
  m_normalsAreBound[cloth.firstSquare[0] + toSize(tile)] = 0;
  if (mesh.patches.empty()) return;
  for (const int patch : mesh.patchesTouched[toSize(tile)]) {
    const PatchOf of = {indexOf(cloth), patch};
    if (flatnessOf(of) != Flatness::flat) continue;
    flatnessOf(of) = Flatness::wasFlat;
    m_stirred.push_back(of);
  }
}

// What was not flat is not looked at: pairs of its parts may have planes.
void GuardBounds::renewPatches() {
  for (const PatchOf& of : m_lost) flatnessOf(of) = Flatness::perhapsNot;
  m_lost.clear();
  for (const PatchOf& of : m_stirred) {
    const Cloth& cloth = m_cloths[of.cloth];
    if (isFlat(cloth, cloth.mesh->patches[toSize(of.patch)])) {
      flatnessOf(of) = Flatness::flat;
    } else {
      flatnessOf(of) = Flatness::lost;
      m_lost.push_back(of);
    }
  }
  m_stirred.clear();
}

// And whether they are flat with what is next to them.
void GuardBounds::forgetSquaresOf(const Cloth& cloth, int tile) {
  const GuardGrid grid = {*cloth.mesh};
  for (int k = 0; k < GuardGrid::kLevels; ++k) {
    const GridRectangle own = grid.squaresIn(0, tile / grid.mesh.tileColumns, tile % grid.mesh.tileColumns, k);
    for (int row = std::max(own.firstRow - 1, 0); row <= own.lastRow; ++row) {
      for (int column = std::max(own.firstColumn - 1, 0); column <= own.lastColumn; ++column) {
        const std::size_t square = cloth.firstSquare[k] + toSize(grid.squareAt(k, row, column));
        m_levels[k].four[square] = Flatness::unknown;
        if (k > 0 && row >= own.firstRow && column >= own.firstColumn) m_levels[k].isBound[square] = 0;
      }
    }
  }
}

// --- boxes ----------------------------------------------------------------------------------------------------------

GuardBox GuardBounds::vertex(const Cloth& cloth, int node) const { return boxOf(cloth, &node, 1); }

GuardBox GuardBounds::boxOf(const Cloth& cloth, const int* nodes, int count) const {
  GuardBox box;
  for (int k = 0; k < count; ++k) {
    const GuardNodes::Way& way = m_nodes->expected[toSize(cloth.firstNode + nodes[k])];
    const Quad start = load<Quad>(way.start.at);
    const Quad end = load<Quad>(way.end.at);
    const Quad slack = splat<3>(start);
    box.include(lesser(start, end) - slack);
    box.include(greater(start, end) + slack);
  }
  box.grow(m_near / 2);
  return box;
}

GuardBounds::Square GuardBounds::squareOf(const Cloth& cloth, const GridRectangle& nodes) const {
  btScalar low[3][kNumbersOfWay];
  btScalar high[3][kNumbersOfWay];
  const int columns = cloth.mesh->columns;
  const int first = cloth.firstNode + nodes.firstRow * columns + nodes.firstColumn;
  runOnBestLanes(Surround{&m_nodes->expected[toSize(first)], nodes.lastRow - nodes.firstRow + 1,
                          nodes.lastColumn - nodes.firstColumn + 1, columns, low, high});
  const btScalar slack = high[0][3];
  return {boxAround(low[0], high[0], slack + m_near / 2),
          {boxAround(low[1], high[1], 2 * slack), boxAround(low[2], high[2], 2 * slack)}};
}

void GuardBounds::findTile(const Cloth& cloth, int tile) {
  const GuardMesh& mesh = *cloth.mesh;
  const std::size_t k = cloth.firstSquare[0] + toSize(tile);
  Square& square = m_levels[0].squares[k];
  m_levels[0].isBound[k] = 1;
  if (mesh.isGrid()) {
    square = squareOf(cloth, GuardGrid{mesh}.nodesOf(0, tile / mesh.tileColumns, tile % mesh.tileColumns));
    return m_parts.forget(k);
  }
  square.box = m_parts.bound(k);
}

const GuardBounds::Square& GuardBounds::squareAt(const Cloth& cloth, int level, int row, int column) {
  const GuardGrid grid = {*cloth.mesh};
  const std::size_t k = cloth.firstSquare[level] + toSize(grid.squareAt(level, row, column));
  Level& squares = m_levels[level];
  if (!squares.isBound[k]) {
    squares.isBound[k] = 1;
    squares.squares[k] = squareOf(cloth, grid.nodesOf(level, row, column));
  }
  return squares.squares[k];
}

void GuardBounds::boundParts(const Cloth& cloth, int cell) {
  unsigned char& areBound = m_partsAreBound[cloth.firstCell + toSize(cell)];
  if (areBound) return;
  areBound = 1;
  const GuardMesh& mesh = *cloth.mesh;
  const GuardMesh::Cell& first = mesh.cells[toSize(cell)];
  const GuardMesh::Cell& end = mesh.cells[toSize(cell) + 1];
  for (int k = first.edge; k < end.edge; ++k) {
    m_edges[cloth.firstEdge + toSize(k)] = boxOf(cloth, mesh.edges[toSize(k)].node, 2);
  }
  for (int k = first.face; k < end.face; ++k) {
    m_faces[cloth.firstFace + toSize(k)] = boxOf(cloth, mesh.faces[toSize(k)].node, 3);
  }
}

// --- sheets that cannot meet themselves -----------------------------------------------------------------------------

bool GuardBounds::isFlat(const Cloth& cloth) {
  if (!cloth.mesh->isGrid()) return false;
  return areFlatNow(cloth, 0, {0, cloth.mesh->tileRows - 1, 0, cloth.mesh->tileColumns - 1});
}

// What is known of four squares holds for any of them, and in what follows from it only those of the rectangle have a
// say.
bool GuardBounds::areFlat(const Cloth& cloth, int level, const GridRectangle& squares) {
  if (!areNear(level, squares)) return false;
  if (!squares.reachesAtMost(1)) return areFlatNow(cloth, level, squares);
  const GuardGrid grid = {*cloth.mesh};
  const int row = squares.firstRow;
  const int column = squares.firstColumn;
  Flatness& known = m_levels[level].four[cloth.firstSquare[level] + toSize(grid.squareAt(level, row, column))];
  if (known == Flatness::unknown) {
    const GridRectangle four = {row, std::min(row + 1, grid.rows(level) - 1), column,
                                std::min(column + 1, grid.columns(level) - 1)};
    known = areFlatNow(cloth, level, four) ? Flatness::flat : Flatness::perhapsNot;
  }
  return known == Flatness::flat;
}

bool GuardBounds::areFlatNow(const Cloth& cloth, int level, const GridRectangle& squares) {
  const GuardGrid grid = {*cloth.mesh};
  SheetBounds bounds;
  for (int row = squares.firstRow; row <= squares.lastRow; ++row) {
    for (int column = squares.firstColumn; column <= squares.lastColumn; ++column) {
      if (!isWhole(grid, level, row, column)) return false;
      bounds.include(squareAt(cloth, level, row, column).vectors);
    }
  }
  return bounds.areOfASheetThatCannotMeetItself();
}

// What of two tiles is left out where it is flat: the first patch that has both, which has what is around a tile where
// there is such a one. Where that is not flat, others of both are tried in vain most of the time.
std::size_t GuardBounds::patchOf(const Cloth& cloth, const GuardMesh::TileInPatch& both) {
  return toSize(cloth.mesh->patchesOfTiles[toSize(both.firstPatch)]);
}

bool GuardBounds::areInAFlatPatch(const Cloth& cloth, int tileA, int tileB) {
  return m_patchesPay[indexOf(cloth)] && isFirstPatchFlat(cloth, tileA, tileB);
}

// They do where all are flat. Where half of them are, as in cloth that is worn, they cost more than what they leave
// out.
bool GuardBounds::doPatchesPay(const Cloth& cloth) {
  const GuardMesh& mesh = *cloth.mesh;
  if (mesh.patches.empty()) return false;
  const std::size_t every = std::max<std::size_t>(mesh.tiles.size() / kTriedFirst, 1);
  for (std::size_t tile = 0; tile < mesh.tiles.size(); tile += every) {
    if (!isFirstPatchFlat(cloth, static_cast<int>(tile), static_cast<int>(tile))) return false;
  }
  return true;
}

bool GuardBounds::isFirstPatchFlat(const Cloth& cloth, int tileA, int tileB) {
  const GuardMesh& mesh = *cloth.mesh;
  const GuardMesh::TileInPatch* const both = mesh.inPatches(tileA, tileB);
  if (!both) return false;
  const std::size_t patch = patchOf(cloth, *both);
  Flatness& known = m_patches[cloth.firstPatch + patch];
  if (known == Flatness::unknown) {
    known = isFlat(cloth, mesh.patches[patch]) ? Flatness::flat : Flatness::perhapsNot;
  }
  return known == Flatness::flat;
}

bool GuardBounds::wereInAFlatPatch(const Cloth& cloth, int tileA, int tileB) const {
  if (m_lost.empty()) return false;
  const GuardMesh::TileInPatch* const both = cloth.mesh->inPatches(tileA, tileB);
  return both && m_patches[cloth.firstPatch + patchOf(cloth, *both)] == Flatness::lost;
}

bool GuardBounds::isFlat(const Cloth& cloth, const SheetPatch& patch) {
  for (const int tile : patch.tiles) {
    const std::size_t k = cloth.firstSquare[0] + toSize(tile);
    if (m_normalsAreBound[k]) continue;
    m_normalsAreBound[k] = 1;
    m_normals[k] = normalsOfTile(*cloth.mesh, tile, *m_nodes, cloth.firstNode);
  }
  return cannotMeetItself(patch, &m_normals[cloth.firstSquare[0]], *m_nodes, cloth.firstNode);
}

// Whether it has two triangles in each cell; those of the last row and column have none.
bool GuardBounds::isWhole(const GuardGrid& grid, int level, int row, int column) {
  const GuardMesh& mesh = grid.mesh;
  if (level < GuardGrid::kCells) return mesh.tiles[toSize(grid.tileOf(level, row, column))].isWhole;
  if (row + 1 == mesh.rows || column + 1 == mesh.columns) return true;
  const std::size_t cell = toSize(grid.cellAt(row, column));
  return mesh.cells[cell + 1].face - mesh.cells[cell].face == 2;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
