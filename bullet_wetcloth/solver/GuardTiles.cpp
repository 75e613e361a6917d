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

void GuardTiles::add(const GuardMesh& mesh, std::size_t firstNode) {
  const bool isFirst = m_cloths.empty();
  const std::size_t cells = isFirst ? 0 : m_cloths.back().firstCell + m_cloths.back().mesh->cells.size();
  const std::size_t edges = isFirst ? 0 : m_cloths.back().firstEdge + m_cloths.back().mesh->edges.size();
  const std::size_t faces = isFirst ? 0 : m_cloths.back().firstFace + m_cloths.back().mesh->faces.size();
  const std::size_t quarters = isFirst ? 0 : m_quarters.size();
  m_cloths.push_back({&mesh, static_cast<int>(firstNode), m_tiles.size(), cells, edges, faces, quarters});
  m_quarters.resize(quarters + toSize(quarterRows(mesh) * quarterColumns(mesh)));
  for (std::size_t k = 0; k < mesh.tiles.size(); ++k) m_tiles.push_back({m_cloths.size() - 1, static_cast<int>(k)});
  m_boxes.resize(m_tiles.size());
  m_vectors.resize(m_tiles.size());
  m_cellBoxes.resize(cells + mesh.cells.size());
  m_cellVectors.resize(cells + mesh.cells.size());
  m_edgeBoxes.resize(edges + mesh.edges.size());
  m_faceBoxes.resize(faces + mesh.faces.size());
}

// --- what is expected -----------------------------------------------------------------------------------------------

// Where nodes are at the end of what is expected, if they keep to their ways.
void GuardTiles::findEnds() {
  const Quad steps = everywhere<Quad>(static_cast<btScalar>(m_expectation.steps));
  m_ends.resize(m_nodes->to.size());
  for (std::size_t node = 0; node < m_ends.size(); ++node) {
    const Quad from = load<Quad>(m_nodes->from[node].at);
    store(m_ends[node].at, from + steps * (load<Quad>(m_nodes->to[node].at) - from));
  }
}

WETCLOTH_INLINE void GuardTiles::include(int node, GuardBox& box) const {
  box.include(load<Quad>(m_nodes->from[toSize(node)].at));
  box.include(load<Quad>(m_ends[toSize(node)].at));
}

WETCLOTH_INLINE void GuardTiles::includeVector(int from, int to, GuardBox& box) const {
  box.include(load<Quad>(m_nodes->from[toSize(to)].at) - load<Quad>(m_nodes->from[toSize(from)].at));
  box.include(load<Quad>(m_ends[toSize(to)].at) - load<Quad>(m_ends[toSize(from)].at));
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
  box.grow(m_expectation.slack + m_expectation.near / 2);
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
  bounds.u.grow(2 * m_expectation.slack);
  bounds.v.grow(2 * m_expectation.slack);
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
  m_boxes[tile].grow(m_expectation.slack + m_expectation.near / 2);
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
    box.grow(m_expectation.slack + m_expectation.near / 2);
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
  const int firstRow = std::min(tileA / mesh.tileColumns, tileB / mesh.tileColumns);
  const int lastRow = std::max(tileA / mesh.tileColumns, tileB / mesh.tileColumns);
  const int firstColumn = std::min(tileA % mesh.tileColumns, tileB % mesh.tileColumns);
  const int lastColumn = std::max(tileA % mesh.tileColumns, tileB % mesh.tileColumns);
  if (lastRow - firstRow > kTilesApart || lastColumn - firstColumn > kTilesApart) return false;
  SheetBounds bounds;
  for (int row = firstRow; row <= lastRow; ++row) {
    for (int column = firstColumn; column <= lastColumn; ++column) {
      const std::size_t tile = toSize(row * mesh.tileColumns + column);
      if (!mesh.tiles[tile].isWhole) return false;
      bounds.include(m_vectors[cloth.firstTile + tile]);
    }
  }
  return bounds.areOfASheetThatCannotMeetItself();
}

bool GuardTiles::isWanted(const Scope& scope, std::size_t tileA, std::size_t tileB) const {
  const std::size_t a = m_tiles[tileA].cloth;
  const std::size_t b = m_tiles[tileB].cloth;
  const bool isOfBodies[2] = {m_cloths[a].mesh->isOfBodies, m_cloths[b].mesh->isOfBodies};
  if (isOfBodies[0] || isOfBodies[1]) return isOfBodies[0] != isOfBodies[1];
  return a == b ? scope.self : scope.others;
}

void GuardTiles::findPairs(const GuardNodes& nodes, const Expectation& expectation, const Scope& scope,
                           GuardCandidates& pairs) {
  m_nodes = &nodes;
  m_expectation = expectation;
  m_pairs = &pairs;
  m_cellsAreBound.assign(m_tiles.size(), false);
  for (Quarter& quarter : m_quarters) quarter.isBound = false;
  findEnds();
  for (std::size_t tile = 0; tile < m_tiles.size(); ++tile) boundTile(tile);
  m_isFlat.clear();
  for (const Cloth& cloth : m_cloths) m_isFlat.push_back(isFlat(cloth));
  for (std::size_t a = 0; a < m_tiles.size(); ++a) {
    for (std::size_t b = a; b < m_tiles.size(); ++b) {
      const bool isSelf = m_tiles[a].cloth == m_tiles[b].cloth;
      if (!isWanted(scope, a, b) || !m_boxes[a].overlaps(m_boxes[b])) continue;
      if (isSelf &&
          (m_isFlat[m_tiles[a].cloth] || isFlat(m_cloths[m_tiles[a].cloth], m_tiles[a].index, m_tiles[b].index))) {
        continue;
      }
      lookAtTiles(a, b);
    }
  }
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
  const auto forEachQuarter = [&](int tile, const auto& action) {
    const int row = tile / mesh.tileColumns * 2;
    const int column = tile % mesh.tileColumns * 2;
    for (int i = row; i < std::min(row + 2, quarterRows(mesh)); ++i) {
      for (int k = column; k < std::min(column + 2, quarterColumns(mesh)); ++k) action(i, k);
    }
  };
  forEachQuarter(tileA, [&](int rowA, int columnA) {
    forEachQuarter(tileB, [&](int rowB, int columnB) {
      const bool isOne = rowA == rowB && columnA == columnB;
      if (tileA == tileB && std::tie(rowB, columnB) < std::tie(rowA, columnA)) return;
      if (!quarter(cloth, rowA, columnA).box.overlaps(quarter(cloth, rowB, columnB).box)) return;
      if (areQuartersFlat(cloth, {std::min(rowA, rowB), std::max(rowA, rowB), std::min(columnA, columnB),
                                  std::max(columnA, columnB)})) {
        return;
      }
      boundCells(cloth.firstTile + toSize(tileA));
      boundCells(cloth.firstTile + toSize(tileB));
      const auto forEachCell = [&](int row, int column, const auto& action) {
        for (int i = row * kQuarter; i < std::min((row + 1) * kQuarter, mesh.rows); ++i) {
          for (int k = column * kQuarter; k < std::min((column + 1) * kQuarter, mesh.columns); ++k) {
            action(cellAt(mesh, i, k));
          }
        }
      };
      forEachCell(rowA, columnA, [&](int cellA) {
        forEachCell(rowB, columnB, [&](int cellB) {
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
  SheetBounds bounds;
  for (int row = std::min(a.row, b.row); row <= std::max(a.row, b.row); ++row) {
    for (int column = std::min(a.column, b.column); column <= std::max(a.column, b.column); ++column) {
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
  box.grow(m_expectation.slack + m_expectation.near / 2);
  return box;
}

GuardBox GuardTiles::boxOfFace(const Cloth& cloth, int face) const {
  GuardBox box;
  for (const int node : cloth.mesh->faces[toSize(face)].node) include(cloth.firstNode + node, box);
  box.grow(m_expectation.slack + m_expectation.near / 2);
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
                 b.firstNode + other.node[1]}},
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
    box.grow(m_expectation.slack + m_expectation.near / 2);
    for (int k = beginB.face; k < endB.face; ++k) {
      if (!box.overlaps(m_faceBoxes[b.firstFace + toSize(k)])) continue;
      const GuardMesh::Face& face = b.mesh->faces[toSize(k)];
      addTo<1>({{node, b.firstNode + face.node[0], b.firstNode + face.node[1], b.firstNode + face.node[2]}},
               m_pairs->vertexFace);
    }
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
