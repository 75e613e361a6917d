// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardTiles.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Rows and columns between two tiles or cells beyond which a flat rectangle around both is not tried.
constexpr int kTilesApart = 2;
constexpr int kCellsApart = 3;

constexpr int kQuarter = GuardMesh::kSide / 2;

int quarterRows(const GuardMesh& mesh) { return (mesh.rows + kQuarter - 1) / kQuarter; }
int quarterColumns(const GuardMesh& mesh) { return (mesh.columns + kQuarter - 1) / kQuarter; }

int tileAt(const GuardMesh& mesh, int row, int column) {
  return row / GuardMesh::kSide * mesh.tileColumns + column / GuardMesh::kSide;
}

int cellAt(const GuardMesh& mesh, int row, int column) {
  constexpr int kSide = GuardMesh::kSide;
  const GuardMesh::Tile& tile = mesh.tiles[toSize(tileAt(mesh, row, column))];
  const int width = std::min(kSide, mesh.columns - column / kSide * kSide);
  return tile.cell + row % kSide * width + column % kSide;
}

// Rows and columns of tiles from one to another.
struct TilesAround {
  int firstRow, lastRow;
  int firstColumn, lastColumn;

  TilesAround(const GuardMesh& mesh, int a, int b)
      : firstRow(std::min(a / mesh.tileColumns, b / mesh.tileColumns)),
        lastRow(std::max(a / mesh.tileColumns, b / mesh.tileColumns)),
        firstColumn(std::min(a % mesh.tileColumns, b % mesh.tileColumns)),
        lastColumn(std::max(a % mesh.tileColumns, b % mesh.tileColumns)) {}
  bool isSmall() const { return lastRow - firstRow <= kTilesApart && lastColumn - firstColumn <= kTilesApart; }
};

// Calls action(row, column) for the quarters of a tile.
template <class Action>
void forEachQuarter(const GuardMesh& mesh, int tile, const Action& action) {
  const int row = tile / mesh.tileColumns * 2;
  const int column = tile % mesh.tileColumns * 2;
  for (int i = row; i < std::min(row + 2, quarterRows(mesh)); ++i) {
    for (int k = column; k < std::min(column + 2, quarterColumns(mesh)); ++k) action(i, k);
  }
}

// Calls action(cell) for the cells of a quarter; they are all in one tile.
template <class Action>
void forEachCell(const GuardMesh& mesh, int quarterRow, int quarterColumn, const Action& action) {
  const int endRow = std::min((quarterRow + 1) * kQuarter, mesh.rows);
  const int firstColumn = quarterColumn * kQuarter;
  const int endColumn = std::min(firstColumn + kQuarter, mesh.columns);
  for (int row = quarterRow * kQuarter; row < endRow; ++row) {
    const int first = cellAt(mesh, row, firstColumn);
    for (int cell = first; cell < first + endColumn - firstColumn; ++cell) action(cell);
  }
}

// Parts that share a node are no pair.
template <int first>
void addTo(const GuardPair& pair, std::vector<GuardPair>& pairs) {
  for (int i = 0; i < first; ++i) {
    for (int k = first; k < 4; ++k) {
      if (pair.node[i] == pair.node[k]) return;
    }
  }
  pairs.push_back(pair);
}

bool isInside(const GuardMesh& mesh, int row, int column) { return row + 1 < mesh.rows && column + 1 < mesh.columns; }

}  // namespace

void GuardTiles::clear() {
  m_cloths.clear();
  m_tiles.clear();
}

void GuardTiles::add(const GuardMesh& mesh, std::size_t firstNode, bool isImposed) {
  const bool isFirst = m_cloths.empty();
  const std::size_t cells = isFirst ? 0 : m_cloths.back().firstCell + m_cloths.back().mesh->cells.size();
  const std::size_t edges = isFirst ? 0 : m_cloths.back().firstEdge + m_cloths.back().mesh->edges.size();
  const std::size_t faces = isFirst ? 0 : m_cloths.back().firstFace + m_cloths.back().mesh->faces.size();
  const std::size_t quarters = isFirst ? 0 : m_quarters.size();
  m_cloths.push_back({&mesh, static_cast<int>(firstNode), static_cast<int>(mesh.firstTileOfNode.size()), isImposed,
                      m_tiles.size(), cells, edges, faces, quarters});
  m_quarters.resize(quarters + toSize(quarterRows(mesh) * quarterColumns(mesh)));
  for (std::size_t k = 0; k < mesh.tiles.size(); ++k) m_tiles.push_back({m_cloths.size() - 1, static_cast<int>(k)});
  m_boxes.resize(m_tiles.size());
  m_vectors.resize(m_tiles.size());
  m_cellBoxes.resize(cells + mesh.cells.size());
  m_cellVectors.resize(cells + mesh.cells.size());
  m_fourCells.resize(cells + mesh.cells.size());
  m_edgeBoxes.resize(edges + mesh.edges.size());
  m_faceBoxes.resize(faces + mesh.faces.size());
}

// --- what is expected -----------------------------------------------------------------------------------------------

WETCLOTH_INLINE void GuardTiles::include(int node, GuardBox& box) const {
  const Quad from = load<Quad>(m_nodes->start[toSize(node)].at);
  const Quad end = load<Quad>(m_nodes->end[toSize(node)].at);
  const Quad slack = splat<3>(from);
  box.include(lesser(from, end) - slack);
  box.include(greater(from, end) + slack);
}

WETCLOTH_INLINE void GuardTiles::includeVector(int from, int to, GuardBox& box) const {
  const GuardNodes& nodes = *m_nodes;
  const Quad start = load<Quad>(nodes.start[toSize(to)].at) - load<Quad>(nodes.start[toSize(from)].at);
  const Quad end = load<Quad>(nodes.end[toSize(to)].at) - load<Quad>(nodes.end[toSize(from)].at);
  const Quad slack = everywhere<Quad>(nodes.start[toSize(to)].at[3] + nodes.start[toSize(from)].at[3]);
  box.include(lesser(start, end) - slack);
  box.include(greater(start, end) + slack);
}

// --- tiles ----------------------------------------------------------------------------------------------------------

GuardTiles::Rectangle GuardTiles::nodesOfTile(const GuardMesh& mesh, int tile) const {
  constexpr int kSide = GuardMesh::kSide;
  const int row = tile / mesh.tileColumns * kSide;
  const int column = tile % mesh.tileColumns * kSide;
  return {row, std::min(row + kSide, mesh.rows - 1), column, std::min(column + kSide, mesh.columns - 1)};
}

GuardBox GuardTiles::boxOf(const Cloth& cloth, const Rectangle& nodes) const {
  GuardBox box;
  for (int row = nodes.firstRow; row <= nodes.lastRow; ++row) {
    for (int column = nodes.firstColumn; column <= nodes.lastColumn; ++column) {
      include(cloth.firstNode + row * cloth.mesh->columns + column, box);
    }
  }
  box.grow(m_near / 2);
  return box;
}

SheetBounds GuardTiles::vectorsOf(const Cloth& cloth, const Rectangle& nodes) const {
  SheetBounds bounds;
  for (int row = nodes.firstRow; row <= nodes.lastRow; ++row) {
    for (int column = nodes.firstColumn; column <= nodes.lastColumn; ++column) {
      const int node = cloth.firstNode + row * cloth.mesh->columns + column;
      if (column < nodes.lastColumn) includeVector(node, node + 1, bounds.u);
      if (row < nodes.lastRow) includeVector(node, node + cloth.mesh->columns, bounds.v);
    }
  }
  return bounds;
}

void GuardTiles::boundTile(std::size_t tile) {
  const Cloth& cloth = m_cloths[m_tiles[tile].cloth];
  const GuardMesh& mesh = *cloth.mesh;
  if (mesh.isGrid()) {
    const Rectangle nodes = nodesOfTile(mesh, m_tiles[tile].index);
    m_boxes[tile] = boxOf(cloth, nodes);
    m_vectors[tile] = vectorsOf(cloth, nodes);
    return;
  }
  const GuardMesh::Tile& parts = mesh.tiles[toSize(m_tiles[tile].index)];
  m_boxes[tile] = GuardBox();
  for (int face = mesh.cells[toSize(parts.cell)].face; face < mesh.cells[toSize(parts.endCell)].face; ++face) {
    for (const int node : mesh.faces[toSize(face)].node) include(cloth.firstNode + node, m_boxes[tile]);
  }
  m_boxes[tile].grow(m_near / 2);
}

void GuardTiles::boundCells(std::size_t tile) {
  if (m_cellsAreBound[tile]) return;
  m_cellsAreBound[tile] = true;
  const Cloth& cloth = m_cloths[m_tiles[tile].cloth];
  const GuardMesh& mesh = *cloth.mesh;
  const GuardMesh::Tile& parts = mesh.tiles[toSize(m_tiles[tile].index)];
  const GuardMesh::Cell& first = mesh.cells[toSize(parts.cell)];
  const GuardMesh::Cell& end = mesh.cells[toSize(parts.endCell)];
  for (int k = first.edge; k < end.edge; ++k) m_edgeBoxes[cloth.firstEdge + toSize(k)] = boxOfEdge(cloth, k);
  for (int k = first.face; k < end.face; ++k) m_faceBoxes[cloth.firstFace + toSize(k)] = boxOfFace(cloth, k);
  for (int k = parts.cell; k < parts.endCell; ++k) {
    const GuardMesh::Cell& cell = mesh.cells[toSize(k)];
    GuardBox& box = m_cellBoxes[cloth.firstCell + toSize(k)];
    if (mesh.isGrid()) {
      const Rectangle nodes = {cell.row, std::min(cell.row + 1, mesh.rows - 1), cell.column,
                               std::min(cell.column + 1, mesh.columns - 1)};
      box = boxOf(cloth, nodes);
      m_cellVectors[cloth.firstCell + toSize(k)] = vectorsOf(cloth, nodes);
      continue;
    }
    box = GuardBox();
    for (const int node : mesh.faces[toSize(cell.face)].node) include(cloth.firstNode + node, box);
    box.grow(m_near / 2);
  }
}

// Whether a whole cloth is one sheet that cannot meet itself.
bool GuardTiles::isFlat(const Cloth& cloth) const {
  if (!cloth.mesh->isGrid()) return false;
  SheetBounds bounds;
  for (std::size_t tile = 0; tile < cloth.mesh->tiles.size(); ++tile) {
    if (!cloth.mesh->tiles[tile].isWhole) return false;
    bounds.include(m_vectors[cloth.firstTile + tile]);
  }
  return bounds.areOfASheetThatCannotMeetItself();
}

// Whether the rectangle around two tiles is one sheet that cannot meet itself.
bool GuardTiles::isFlat(const Cloth& cloth, int tileA, int tileB) const {
  const GuardMesh& mesh = *cloth.mesh;
  if (!mesh.isGrid()) return false;
  const TilesAround around(mesh, tileA, tileB);
  if (!around.isSmall()) return false;
  SheetBounds bounds;
  for (int row = around.firstRow; row <= around.lastRow; ++row) {
    for (int column = around.firstColumn; column <= around.lastColumn; ++column) {
      const std::size_t tile = toSize(row * mesh.tileColumns + column);
      if (!mesh.tiles[tile].isWhole) return false;
      bounds.include(m_vectors[cloth.firstTile + tile]);
    }
  }
  return bounds.areOfASheetThatCannotMeetItself();
}

bool GuardTiles::isWanted(std::size_t tileA, std::size_t tileB) const {
  const std::size_t a = m_tiles[tileA].cloth;
  const std::size_t b = m_tiles[tileB].cloth;
  if (m_cloths[a].isImposed && m_cloths[b].isImposed) return false;
  if (m_cloths[a].mesh->isOfBodies || m_cloths[b].mesh->isOfBodies) return true;
  return a == b ? m_scope.self : m_scope.others;
}

void GuardTiles::findPairs(const GuardNodes& nodes, btScalar near, const Scope& scope, GuardCandidates& pairs) {
  m_nodes = &nodes;
  m_near = near;
  m_scope = scope;
  m_pairs = &pairs;
  m_isFlat.assign(m_cloths.size(), false);
  m_isNew.assign(m_tiles.size(), true);
  findPairs();
}

void GuardTiles::findPairsAgain(const GuardNodes& nodes, const std::vector<int>& changed, GuardCandidates& pairs) {
  m_nodes = &nodes;
  m_pairs = &pairs;
  m_isNew.assign(m_tiles.size(), false);
  for (const int node : changed) markTilesOf(node);
  findPairs();
}

void GuardTiles::markTilesOf(int node) {
  for (const Cloth& cloth : m_cloths) {
    const int own = node - cloth.firstNode;
    if (own < 0 || own >= cloth.nodeCount) continue;
    const GuardMesh& mesh = *cloth.mesh;
    for (int k = mesh.firstTileOfNode[toSize(own)]; k < mesh.endTileOfNode[toSize(own)]; ++k) {
      m_isNew[cloth.firstTile + toSize(mesh.tilesOfNodes[toSize(k)])] = true;
    }
  }
}

// Whether bounds of a new tile had a say in what was found of these two.
bool GuardTiles::areLookedAtAgain(int tileA, int tileB) const {
  const Tile& a = m_tiles[toSize(tileA)];
  const Tile& b = m_tiles[toSize(tileB)];
  if (m_isNew[toSize(tileA)] || m_isNew[toSize(tileB)]) return true;
  const Cloth& cloth = m_cloths[a.cloth];
  if (a.cloth != b.cloth || !cloth.mesh->isGrid()) return false;
  const TilesAround around(*cloth.mesh, a.index, b.index);
  if (!around.isSmall()) return false;
  for (int row = around.firstRow; row <= around.lastRow; ++row) {
    for (int column = around.firstColumn; column <= around.lastColumn; ++column) {
      if (m_isNew[cloth.firstTile + toSize(row * cloth.mesh->tileColumns + column)]) return true;
    }
  }
  return false;
}

void GuardTiles::forgetBounds(std::size_t tile) {
  m_cellsAreBound[tile] = false;
  const Cloth& cloth = m_cloths[m_tiles[tile].cloth];
  if (!cloth.mesh->isGrid()) return;
  const GuardMesh& mesh = *cloth.mesh;
  forEachQuarter(mesh, m_tiles[tile].index, [&](int row, int column) {
    m_quarters[cloth.firstQuarter + toSize(row * quarterColumns(mesh) + column)].isBound = false;
  });
  const Rectangle nodes = nodesOfTile(mesh, m_tiles[tile].index);
  for (int row = std::max(nodes.firstRow - 1, 0); row <= nodes.lastRow; ++row) {
    for (int column = std::max(nodes.firstColumn - 1, 0); column <= nodes.lastColumn; ++column) {
      m_fourCells[cloth.firstCell + toSize(row * mesh.columns + column)] = Flatness::unknown;
    }
  }
}

// As long as a cloth as a whole cannot meet itself, its tiles are not looked at; when it may, all of them are.
void GuardTiles::findPairs() {
  m_cellsAreBound.resize(m_tiles.size());
  for (std::size_t tile = 0; tile < m_tiles.size(); ++tile) {
    if (!m_isNew[tile]) continue;
    boundTile(tile);
    forgetBounds(tile);
  }
  for (std::size_t c = 0; c < m_cloths.size(); ++c) {
    const bool wasFlat = m_isFlat[c];
    m_isFlat[c] = isFlat(m_cloths[c]);
    if (!wasFlat || m_isFlat[c]) continue;
    const auto first = m_isNew.begin() + static_cast<std::ptrdiff_t>(m_cloths[c].firstTile);
    std::fill(first, first + static_cast<std::ptrdiff_t>(m_cloths[c].mesh->tiles.size()), true);
  }
  sortTiles();
  for (std::size_t i = 0; i < m_sorted.size(); ++i) {
    const std::size_t one = toSize(m_sorted[i]);
    for (std::size_t k = i; k < m_sorted.size(); ++k) {
      const std::size_t other = toSize(m_sorted[k]);
      if (m_boxes[other].low[m_axis] > m_boxes[one].high[m_axis]) break;
      if (m_boxes[one].overlaps(m_boxes[other])) lookAtNearTiles(std::min(one, other), std::max(one, other));
    }
  }
}

// Along the axis along which they are spread the most.
void GuardTiles::sortTiles() {
  GuardBox all;
  for (const GuardBox& box : m_boxes) all.include(box);
  m_axis = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (all.high[axis] - all.low[axis] > all.high[m_axis] - all.low[m_axis]) m_axis = axis;
  }
  m_sorted.resize(m_tiles.size());
  for (std::size_t k = 0; k < m_sorted.size(); ++k) m_sorted[k] = static_cast<int>(k);
  std::sort(m_sorted.begin(), m_sorted.end(), [&](int a, int b) {
    const btScalar lowA = m_boxes[toSize(a)].low[m_axis];
    const btScalar lowB = m_boxes[toSize(b)].low[m_axis];
    return lowA != lowB ? lowA < lowB : a < b;
  });
}

void GuardTiles::lookAtNearTiles(std::size_t a, std::size_t b) {
  const Cloth& cloth = m_cloths[m_tiles[a].cloth];
  const bool isSelf = m_tiles[a].cloth == m_tiles[b].cloth;
  if (!isWanted(a, b)) return;
  if (isSelf && m_isFlat[m_tiles[a].cloth]) return;
  if (!areLookedAtAgain(static_cast<int>(a), static_cast<int>(b))) return;
  if (isSelf && isFlat(cloth, m_tiles[a].index, m_tiles[b].index)) return;
  m_pairOfTiles[0] = static_cast<int>(a);
  m_pairOfTiles[1] = static_cast<int>(b);
  lookAtTiles(a, b);
}

// --- cells and parts ------------------------------------------------------------------------------------------------

void GuardTiles::lookAtTiles(std::size_t a, std::size_t b) {
  const Cloth& clothA = m_cloths[m_tiles[a].cloth];
  const Cloth& clothB = m_cloths[m_tiles[b].cloth];
  if (&clothA == &clothB && clothA.mesh->isGrid()) return lookAtQuarters(clothA, m_tiles[a].index, m_tiles[b].index);
  boundCells(a);
  boundCells(b);
  const GuardMesh::Tile& partsA = clothA.mesh->tiles[toSize(m_tiles[a].index)];
  const GuardMesh::Tile& partsB = clothB.mesh->tiles[toSize(m_tiles[b].index)];
  for (int k = partsA.cell; k < partsA.endCell; ++k) {
    if (!m_cellBoxes[clothA.firstCell + toSize(k)].overlaps(m_boxes[b])) continue;
    for (int j = a == b ? k : partsB.cell; j < partsB.endCell; ++j) lookAtNearCells(clothA, k, clothB, j);
  }
}

void GuardTiles::lookAtNearCells(const Cloth& a, int cellA, const Cloth& b, int cellB) {
  if (!m_cellBoxes[a.firstCell + toSize(cellA)].overlaps(m_cellBoxes[b.firstCell + toSize(cellB)])) return;
  if (&a == &b && areCellsFlat(a, cellA, cellB)) return;
  lookAtCells(a, cellA, b, cellB);
}

const GuardTiles::Quarter& GuardTiles::quarter(const Cloth& cloth, int row, int column) {
  const GuardMesh& mesh = *cloth.mesh;
  Quarter& quarter = m_quarters[cloth.firstQuarter + toSize(row * quarterColumns(mesh) + column)];
  if (quarter.isBound) return quarter;
  const Rectangle nodes = {row * kQuarter, std::min((row + 1) * kQuarter, mesh.rows - 1), column * kQuarter,
                           std::min((column + 1) * kQuarter, mesh.columns - 1)};
  quarter = {boxOf(cloth, nodes), vectorsOf(cloth, nodes), true};
  return quarter;
}

bool GuardTiles::areQuartersFlat(const Cloth& cloth, const Rectangle& around) {
  if (around.lastRow - around.firstRow > kTilesApart || around.lastColumn - around.firstColumn > kTilesApart) {
    return false;
  }
  SheetBounds bounds;
  for (int row = around.firstRow; row <= around.lastRow; ++row) {
    for (int column = around.firstColumn; column <= around.lastColumn; ++column) {
      const int tile = tileAt(*cloth.mesh, row * kQuarter, column * kQuarter);
      if (!cloth.mesh->tiles[toSize(tile)].isWhole) return false;
      bounds.include(quarter(cloth, row, column).vectors);
    }
  }
  return bounds.areOfASheetThatCannotMeetItself();
}

// Two tiles of a grid, or a tile and itself.
void GuardTiles::lookAtQuarters(const Cloth& cloth, int tileA, int tileB) {
  const GuardMesh& mesh = *cloth.mesh;
  forEachQuarter(mesh, tileA, [&](int rowA, int columnA) {
    forEachQuarter(mesh, tileB, [&](int rowB, int columnB) {
      const bool isOne = rowA == rowB && columnA == columnB;
      if (tileA == tileB && std::tie(rowB, columnB) < std::tie(rowA, columnA)) return;
      const GuardBox& boxB = quarter(cloth, rowB, columnB).box;
      if (!quarter(cloth, rowA, columnA).box.overlaps(boxB)) return;
      if (areQuartersFlat(cloth, {std::min(rowA, rowB), std::max(rowA, rowB), std::min(columnA, columnB),
                                  std::max(columnA, columnB)})) {
        return;
      }
      boundCells(cloth.firstTile + toSize(tileA));
      boundCells(cloth.firstTile + toSize(tileB));
      forEachCell(mesh, rowA, columnA, [&](int cellA) {
        if (!m_cellBoxes[cloth.firstCell + toSize(cellA)].overlaps(boxB)) return;
        forEachCell(mesh, rowB, columnB, [&](int cellB) {
          if (!isOne || cellA <= cellB) lookAtNearCells(cloth, cellA, cloth, cellB);
        });
      });
    });
  });
}

bool GuardTiles::areCellsFlat(const Cloth& cloth, int cellA, int cellB) {
  const GuardMesh& mesh = *cloth.mesh;
  if (!mesh.isGrid()) return false;
  const GuardMesh::Cell& a = mesh.cells[toSize(cellA)];
  const GuardMesh::Cell& b = mesh.cells[toSize(cellB)];
  if (std::abs(a.row - b.row) > kCellsApart || std::abs(a.column - b.column) > kCellsApart) return false;
  const int row = std::min(a.row, b.row);
  const int column = std::min(a.column, b.column);
  if (std::abs(a.row - b.row) > 1 || std::abs(a.column - b.column) > 1) {
    return areCellsFlat(cloth, {row, std::max(a.row, b.row), column, std::max(a.column, b.column)});
  }
  Flatness& known = m_fourCells[cloth.firstCell + toSize(row * mesh.columns + column)];
  if (known == Flatness::unknown) {
    const bool isFlat =
        areCellsFlat(cloth, {row, std::min(row + 1, mesh.rows - 1), column, std::min(column + 1, mesh.columns - 1)});
    known = isFlat ? Flatness::flat : Flatness::perhapsNot;
  }
  return known == Flatness::flat;
}

bool GuardTiles::areCellsFlat(const Cloth& cloth, const Rectangle& cells) {
  const GuardMesh& mesh = *cloth.mesh;
  SheetBounds bounds;
  for (int row = cells.firstRow; row <= cells.lastRow; ++row) {
    for (int column = cells.firstColumn; column <= cells.lastColumn; ++column) {
      const int cell = cellAt(mesh, row, column);
      boundCells(cloth.firstTile + toSize(tileAt(mesh, row, column)));
      const int faces = mesh.cells[toSize(cell) + 1].face - mesh.cells[toSize(cell)].face;
      if (isInside(mesh, row, column) && faces != 2) return false;
      bounds.include(m_cellVectors[cloth.firstCell + toSize(cell)]);
    }
  }
  return bounds.areOfASheetThatCannotMeetItself();
}

GuardBox GuardTiles::boxOfEdge(const Cloth& cloth, int edge) const {
  GuardBox box;
  for (const int node : cloth.mesh->edges[toSize(edge)].node) include(cloth.firstNode + node, box);
  box.grow(m_near / 2);
  return box;
}

GuardBox GuardTiles::boxOfFace(const Cloth& cloth, int face) const {
  GuardBox box;
  for (const int node : cloth.mesh->faces[toSize(face)].node) include(cloth.firstNode + node, box);
  box.grow(m_near / 2);
  return box;
}

void GuardTiles::lookAtCells(const Cloth& a, int cellA, const Cloth& b, int cellB) {
  const bool isOne = &a == &b && cellA == cellB;
  verticesAndFaces(a, cellA, b, cellB);
  if (!isOne) verticesAndFaces(b, cellB, a, cellA);
  const GuardMesh::Cell& beginA = a.mesh->cells[toSize(cellA)];
  const GuardMesh::Cell& endA = a.mesh->cells[toSize(cellA) + 1];
  const GuardMesh::Cell& beginB = b.mesh->cells[toSize(cellB)];
  const GuardMesh::Cell& endB = b.mesh->cells[toSize(cellB) + 1];
  for (int i = beginA.edge; i < endA.edge; ++i) {
    const GuardMesh::Edge& edge = a.mesh->edges[toSize(i)];
    for (int k = isOne ? i + 1 : beginB.edge; k < endB.edge; ++k) {
      if (!m_edgeBoxes[a.firstEdge + toSize(i)].overlaps(m_edgeBoxes[b.firstEdge + toSize(k)])) continue;
      const GuardMesh::Edge& other = b.mesh->edges[toSize(k)];
      addTo<2>({{a.firstNode + edge.node[0], a.firstNode + edge.node[1], b.firstNode + other.node[0],
                 b.firstNode + other.node[1]},
                {m_pairOfTiles[0], m_pairOfTiles[1]}},
               m_pairs->edgeEdge);
    }
  }
}

// The vertices of a cell and the faces of another.
void GuardTiles::verticesAndFaces(const Cloth& a, int cellA, const Cloth& b, int cellB) {
  const GuardMesh::Cell& beginA = a.mesh->cells[toSize(cellA)];
  const GuardMesh::Cell& endA = a.mesh->cells[toSize(cellA) + 1];
  const GuardMesh::Cell& beginB = b.mesh->cells[toSize(cellB)];
  const GuardMesh::Cell& endB = b.mesh->cells[toSize(cellB) + 1];
  for (int i = beginA.vertex; i < endA.vertex; ++i) {
    const int node = a.firstNode + a.mesh->vertices[toSize(i)];
    GuardBox box;
    include(node, box);
    box.grow(m_near / 2);
    for (int k = beginB.face; k < endB.face; ++k) {
      if (!box.overlaps(m_faceBoxes[b.firstFace + toSize(k)])) continue;
      const GuardMesh::Face& face = b.mesh->faces[toSize(k)];
      addTo<1>({{node, b.firstNode + face.node[0], b.firstNode + face.node[1], b.firstNode + face.node[2]},
                {m_pairOfTiles[0], m_pairOfTiles[1]}},
               m_pairs->vertexFace);
    }
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
