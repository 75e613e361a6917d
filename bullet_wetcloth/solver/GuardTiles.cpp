// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardTiles.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

void GuardTiles::clear() {
  m_bounds.clear();
  m_goesByNodes.clear();
  m_isImposed.clear();
  m_firstTile.clear();
  m_tiles.clear();
}

void GuardTiles::add(const GuardMesh& mesh, std::size_t firstNode, bool isImposed) {
  m_firstTile.push_back(m_tiles.size());
  for (std::size_t k = 0; k < mesh.tiles.size(); ++k) m_tiles.push_back({m_isImposed.size(), static_cast<int>(k)});
  m_isImposed.push_back(isImposed);
  m_goesByNodes.push_back(!mesh.isGrid() && !mesh.isOfBodies);
  m_bounds.add(mesh, firstNode);
}

bool GuardTiles::isWanted(std::size_t tileA, std::size_t tileB) const {
  const std::size_t a = m_tiles[tileA].cloth;
  const std::size_t b = m_tiles[tileB].cloth;
  if (m_isImposed[a] && m_isImposed[b]) return false;
  if (m_bounds.cloths()[a].mesh->isOfBodies || m_bounds.cloths()[b].mesh->isOfBodies) return true;
  return a == b ? m_scope.self : m_scope.others;
}

void GuardTiles::findPairs(const GuardNodes& nodes, btScalar near, const Scope& scope, GuardCandidates& pairs) {
  m_bounds.boundTiles(nodes, near);
  m_planes.begin(nodes, near);
  m_scope = scope;
  m_pairs = &pairs;
  m_isFlat.assign(m_isImposed.size(), false);
  m_isNew.assign(m_tiles.size(), true);
  m_newCells.resize(m_tiles.size());
  m_areAllNew = true;
  findPairs();
}

void GuardTiles::findPairsAgain(const std::vector<int>& changed, GuardCandidates& pairs) {
  m_pairs = &pairs;
  m_isNew.assign(m_tiles.size(), false);
  m_bounds.renewNodes(changed);
  for (const int node : changed) markTilesOf(node);
  for (std::size_t tile = 0; tile < m_tiles.size(); ++tile) {
    if (!m_isNew[tile]) continue;
    m_bounds.boundTile(m_bounds.cloths()[m_tiles[tile].cloth], m_tiles[tile].index);
    boundNewCells(tile);
    if (m_bounds.cloths()[m_tiles[tile].cloth].mesh->isOfBodies) m_planes.forget();
  }
  m_bounds.renewPatches();
  m_areAllNew = false;
  findPairs();
}

bool GuardTiles::hasNew(const GuardPair& pair) const {
  return std::any_of(std::begin(pair.node), std::end(pair.node),
                     [&](int node) { return m_bounds.parts().isNew(node); });
}

void GuardTiles::boundNewCells(std::size_t tile) {
  m_newCells[tile] = boxOf(tile);
  if (!m_goesByNodes[m_tiles[tile].cloth]) return;
  m_newCells[tile] = GuardBox();
  const PartBoxes::Blocks faces = m_bounds.parts().blocks(tile, PartBoxes::kFaces);
  for (const PartBoxes::Block* block = faces.begin; block != faces.end; ++block) {
    for (unsigned isNew = block->isNew, k = 0; isNew != 0; isNew >>= 1, ++k) {
      if ((isNew & 1) != 0) m_newCells[tile].include(boxOfCell(tile, block->first + static_cast<int>(k)));
    }
  }
}

void GuardTiles::markTilesOf(int node) {
  for (std::size_t c = 0; c < m_firstTile.size(); ++c) {
    const Cloth& cloth = m_bounds.cloths()[c];
    const int own = node - cloth.firstNode;
    if (own < 0 || own >= cloth.nodeCount) continue;
    const GuardMesh& mesh = *cloth.mesh;
    for (int k = mesh.firstTileOfNode[toSize(own)]; k < mesh.endTileOfNode[toSize(own)]; ++k) {
      m_isNew[m_firstTile[c] + toSize(mesh.tilesOfNodes[toSize(k)])] = true;
    }
  }
}

// Of a grid what is left out stands in for many pairs, and all of two tiles is looked at again.
bool GuardTiles::goByNodes(std::size_t tileA, std::size_t tileB) const {
  return m_goesByNodes[m_tiles[tileA].cloth] || m_goesByNodes[m_tiles[tileB].cloth];
}

bool GuardTiles::isLookedAtAgain(const GuardPair& pair) const {
  if (goByNodes(toSize(pair.tile[0]), toSize(pair.tile[1]))) return hasNew(pair);
  return areLookedAtAgain(pair.tile[0], pair.tile[1]);
}

// Whether bounds of a new tile had a say in what was found of these two.
bool GuardTiles::areLookedAtAgain(int tileA, int tileB) const {
  const Tile& a = m_tiles[toSize(tileA)];
  const Tile& b = m_tiles[toSize(tileB)];
  if (m_isNew[toSize(tileA)] || m_isNew[toSize(tileB)]) return true;
  if (a.cloth != b.cloth) return false;
  const GuardMesh& mesh = *m_bounds.cloths()[a.cloth].mesh;
  const auto isNew = [&](int tile) { return m_isNew[m_firstTile[a.cloth] + toSize(tile)]; };
  if (!mesh.isGrid()) return m_bounds.wereInAFlatPatch(m_bounds.cloths()[a.cloth], a.index, b.index);
  const GridRectangle around = GuardGrid{mesh}.tilesAround(a.index, b.index);
  if (!GuardBounds::areNear(0, around)) return false;
  for (int row = around.firstRow; row <= around.lastRow; ++row) {
    for (int column = around.firstColumn; column <= around.lastColumn; ++column) {
      if (isNew(row * mesh.tileColumns + column)) return true;
    }
  }
  return false;
}

// --- tiles ----------------------------------------------------------------------------------------------------------

void GuardTiles::findPairs() {
  findFlatCloths();
  sortTiles();
  findStirredTiles();
  std::size_t nextStirred = 0;
  for (std::size_t i = 0; i < m_sorted.size(); ++i) {
    const std::size_t one = toSize(m_sorted[i]);
    const btScalar end = boxOf(one).high[m_axis];
    while (nextStirred < m_stirred.size() && m_stirred[nextStirred] < i) ++nextStirred;
    if (m_isStirred[one]) {
      for (std::size_t k = i; k < m_sorted.size(); ++k) {
        if (boxOf(toSize(m_sorted[k])).low[m_axis] > end) break;
        lookAtPair(one, toSize(m_sorted[k]));
      }
    } else {
      for (std::size_t k = nextStirred; k < m_stirred.size(); ++k) {
        const std::size_t other = toSize(m_sorted[m_stirred[k]]);
        if (boxOf(other).low[m_axis] > end) break;
        lookAtPair(one, other);
      }
    }
  }
}

void GuardTiles::lookAtPair(std::size_t one, std::size_t other) {
  if (boxOf(one).overlaps(boxOf(other))) lookAtNearTiles(std::min(one, other), std::max(one, other));
}

// Of a grid all tiles, if one is new.
void GuardTiles::findStirredTiles() {
  m_isStirred = m_isNew;
  for (std::size_t c = 0; c < m_firstTile.size() && !m_areAllNew; ++c) {
    const Cloth& cloth = m_bounds.cloths()[c];
    const auto first = m_isStirred.begin() + static_cast<std::ptrdiff_t>(m_firstTile[c]);
    const auto end = first + static_cast<std::ptrdiff_t>(cloth.mesh->tiles.size());
    const bool areAll = m_goesByNodes[c] ? m_bounds.isAnyPatchLost() : std::find(first, end, true) != end;
    if (areAll) std::fill(first, end, true);
  }
  m_stirred.clear();
  for (std::size_t k = 0; k < m_sorted.size(); ++k) {
    if (m_isStirred[toSize(m_sorted[k])]) m_stirred.push_back(k);
  }
}

// As long as a cloth as a whole cannot meet itself, its tiles are not looked at; when it may, all of them are.
void GuardTiles::findFlatCloths() {
  for (std::size_t c = 0; c < m_isFlat.size(); ++c) {
    const Cloth& cloth = m_bounds.cloths()[c];
    const bool wasFlat = m_isFlat[c];
    m_isFlat[c] = m_bounds.isFlat(cloth);
    if (!wasFlat || m_isFlat[c]) continue;
    const auto first = m_isNew.begin() + static_cast<std::ptrdiff_t>(m_firstTile[c]);
    std::fill(first, first + static_cast<std::ptrdiff_t>(cloth.mesh->tiles.size()), true);
  }
}

// Along the axis along which they are spread the most.
void GuardTiles::sortTiles() {
  GuardBox all;
  for (std::size_t tile = 0; tile < m_tiles.size(); ++tile) all.include(boxOf(tile));
  m_axis = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (all.high[axis] - all.low[axis] > all.high[m_axis] - all.low[m_axis]) m_axis = axis;
  }
  m_sorted.resize(m_tiles.size());
  for (std::size_t k = 0; k < m_sorted.size(); ++k) m_sorted[k] = static_cast<int>(k);
  std::sort(m_sorted.begin(), m_sorted.end(), [&](int a, int b) {
    const btScalar lowA = boxOf(toSize(a)).low[m_axis];
    const btScalar lowB = boxOf(toSize(b)).low[m_axis];
    return lowA != lowB ? lowA < lowB : a < b;
  });
}

void GuardTiles::lookAtNearTiles(std::size_t a, std::size_t b) {
  const Cloth& cloth = m_bounds.cloths()[m_tiles[a].cloth];
  const bool isSelf = m_tiles[a].cloth == m_tiles[b].cloth;
  if (!isWanted(a, b)) return;
  if (isSelf && m_isFlat[m_tiles[a].cloth]) return;
  m_areOnlyNew = false;
  if (!m_areAllNew) {
    if (!areLookedAtAgain(static_cast<int>(a), static_cast<int>(b))) return;
    m_areOnlyNew = goByNodes(a, b) && !(isSelf && m_bounds.wereInAFlatPatch(cloth, m_tiles[a].index, m_tiles[b].index));
    const bool areNear =
        (m_isNew[a] && m_newCells[a].overlaps(boxOf(b))) || (m_isNew[b] && m_newCells[b].overlaps(boxOf(a)));
    if (m_areOnlyNew && !areNear) return;
  }
  if (isSelf && areFlat(cloth, m_tiles[a].index, m_tiles[b].index)) return;
  m_pairOfTiles[0] = static_cast<int>(a);
  m_pairOfTiles[1] = static_cast<int>(b);
  lookAtTiles(a, b);
}

bool GuardTiles::areFlat(const Cloth& cloth, int tileA, int tileB) {
  if (!cloth.mesh->isGrid()) return m_bounds.areInAFlatPatch(cloth, tileA, tileB);
  return m_bounds.areFlat(cloth, 0, GuardGrid{*cloth.mesh}.tilesAround(tileA, tileB));
}

// --- cells and parts ------------------------------------------------------------------------------------------------

void GuardTiles::lookAtTiles(std::size_t a, std::size_t b) {
  const Cloth& clothA = m_bounds.cloths()[m_tiles[a].cloth];
  const Cloth& clothB = m_bounds.cloths()[m_tiles[b].cloth];
  const GuardMesh& meshA = *clothA.mesh;
  const GuardMesh& meshB = *clothB.mesh;
  const int tileA = m_tiles[a].index;
  const int tileB = m_tiles[b].index;
  if (meshA.isGrid() && meshB.isGrid()) {
    return lookAtSquares(clothA, {0, tileA / meshA.tileColumns, tileA % meshA.tileColumns}, clothB,
                         {0, tileB / meshB.tileColumns, tileB % meshB.tileColumns});
  }
  m_bounds.parts().need(a);
  m_bounds.parts().need(b);
  chooseParts(a, b);
  meetVerticesAndFaces(a, 0, b, 1);
  if (a != b) meetVerticesAndFaces(b, 1, a, 0);
  meetEdges(a, b);
}

// Of two tiles the parts that may meet, as far as the boxes around all of them tell, and planes beside bodies.
void GuardTiles::chooseParts(std::size_t a, std::size_t b) {
  const GuardMesh& meshB = *m_bounds.cloths()[m_tiles[b].cloth].mesh;
  if (meshB.isOfBodies && meshB.shellOfTile[toSize(m_tiles[b].index)] >= 0) return choosePartsNotBeyond(a, b);
  GuardBox aroundA = boxOf(a);
  GuardBox aroundB = boxOf(b);
  m_bounds.parts().find(a, PartBoxes::kFaces, aroundB, m_chosen[0][PartBoxes::kFaces]);
  if (partsAreInFaces(a)) aroundA = m_chosen[0][PartBoxes::kFaces].around();
  m_bounds.parts().find(b, PartBoxes::kFaces, aroundA, m_chosen[1][PartBoxes::kFaces]);
  if (partsAreInFaces(b)) aroundB = m_chosen[1][PartBoxes::kFaces].around();
  for (const PartBoxes::Kind kind : {PartBoxes::kVertices, PartBoxes::kEdges}) {
    m_bounds.parts().find(a, kind, aroundB, m_chosen[0][kind]);
    m_bounds.parts().find(b, kind, aroundA, m_chosen[1][kind]);
  }
}

// Whether each vertex and each edge of a tile is one of a face of it. The last row and column of a grid have no faces.
bool GuardTiles::partsAreInFaces(std::size_t tile) const {
  return !m_bounds.cloths()[m_tiles[tile].cloth].mesh->isGrid();
}

void GuardTiles::choosePartsNotBeyond(std::size_t tile, std::size_t bodies) {
  for (ChosenParts(&of)[PartBoxes::kKinds] : m_chosen) {
    for (ChosenParts& parts : of) parts.clear();
  }
  findCellsIn(tile, boxOf(bodies), m_areOnlyNew && !m_isNew[bodies]);
  m_cells.erase(std::remove_if(m_cells.begin(), m_cells.end(), [&](int cell) { return isBeyond(tile, cell, bodies); }),
                m_cells.end());
  if (m_cells.empty()) return;
  GuardBox around;
  for (const int cell : m_cells) around.include(boxOfCell(tile, cell));
  choosePartsOfCells(tile);
  for (int kind = 0; kind < PartBoxes::kKinds; ++kind) {
    m_bounds.parts().find(bodies, static_cast<PartBoxes::Kind>(kind), around, m_chosen[1][kind]);
  }
}

GuardBox GuardTiles::boxOfCell(std::size_t tile, int cell) {
  const Cloth& cloth = m_bounds.cloths()[m_tiles[tile].cloth];
  const GuardMesh::Cell& parts = cloth.mesh->cells[toSize(cell)];
  if (cloth.mesh->isGrid()) return m_bounds.cell(cloth, parts.row, parts.column);
  GuardBox box;
  for (const int node : cloth.mesh->faces[toSize(parts.face)].node) {
    box.include(m_bounds.parts().vertex(cloth.firstNode + node));
  }
  return box;
}

// Of a tile those that may meet what is in this box.
void GuardTiles::findCellsIn(std::size_t tile, const GuardBox& box, bool newOnly) {
  m_cells.clear();
  const Cloth& cloth = m_bounds.cloths()[m_tiles[tile].cloth];
  const GuardMesh::Tile& cells = cloth.mesh->tiles[toSize(m_tiles[tile].index)];
  if (cloth.mesh->isGrid()) {
    for (int cell = cells.cell; cell < cells.endCell; ++cell) {
      if (boxOfCell(tile, cell).overlaps(box)) m_cells.push_back(cell);
    }
    return;
  }
  ChosenParts& faces = m_chosen[0][PartBoxes::kFaces];
  m_bounds.parts().find(tile, PartBoxes::kFaces, box, faces);
  for (const PartBoxes::Chosen& chosen : faces) {
    unsigned parts = newOnly ? chosen.parts & chosen.block->isNew : chosen.parts;
    for (int face = chosen.block->first; parts != 0; parts >>= 1, ++face) {
      if ((parts & 1) != 0) m_cells.push_back(face);
    }
  }
}

// Whether a plane tells a cell from all of a body.
bool GuardTiles::isBeyond(std::size_t tile, int cell, std::size_t bodies) {
  const Cloth& cloth = m_bounds.cloths()[m_tiles[tile].cloth];
  const Cloth& other = m_bounds.cloths()[m_tiles[bodies].cloth];
  const GuardMesh& mesh = *cloth.mesh;
  const GuardMesh::Cell& parts = mesh.cells[toSize(cell)];
  int nodes[4];
  int count = 0;
  if (mesh.isGrid()) {
    const GridRectangle around = GuardGrid{mesh}.nodesOf(GuardGrid::kCells, parts.row, parts.column);
    for (int row = around.firstRow; row <= around.lastRow; ++row) {
      for (int column = around.firstColumn; column <= around.lastColumn; ++column) {
        nodes[count++] = cloth.firstNode + row * mesh.columns + column;
      }
    }
  } else {
    for (const int node : mesh.faces[toSize(parts.face)].node) nodes[count++] = cloth.firstNode + node;
  }
  const int shell = other.mesh->shellOfTile[toSize(m_tiles[bodies].index)];
  return m_planes.areBeyond(nodes, count, *other.mesh, shell, other.firstNode);
}

void GuardTiles::choosePartsOfCells(std::size_t tile) {
  const Cloth& cloth = m_bounds.cloths()[m_tiles[tile].cloth];
  const auto choose = [&](PartBoxes::Kind kind, int begin, int end) {
    const PartBoxes::Block* const blocks = m_bounds.parts().blocks(tile, kind).begin;
    for (int part = begin; part < end; ++part) {
      const std::size_t k = toSize(part - blocks->first);
      m_chosen[0][kind].add(blocks[k / PartBoxes::kLanes], 1u << k % PartBoxes::kLanes);
    }
  };
  for (ChosenParts& chosen : m_chosen[0]) chosen.clear();
  for (const int cell : m_cells) {
    const GuardMesh::Cell& parts = cloth.mesh->cells[toSize(cell)];
    const GuardMesh::Cell& next = cloth.mesh->cells[toSize(cell) + 1];
    choose(PartBoxes::kVertices, parts.vertex, next.vertex);
    choose(PartBoxes::kEdges, parts.edge, next.edge);
    choose(PartBoxes::kFaces, parts.face, next.face);
  }
}

void GuardTiles::meetVerticesAndFaces(std::size_t a, int chosenA, std::size_t b, int chosenB) {
  const Cloth& clothA = m_bounds.cloths()[m_tiles[a].cloth];
  const Cloth& clothB = m_bounds.cloths()[m_tiles[b].cloth];
  PartBoxes::meetFaces(m_chosen[chosenA][PartBoxes::kVertices], m_chosen[chosenB][PartBoxes::kFaces], m_areOnlyNew,
                       m_meetings);
  for (std::size_t k = 0; k < m_meetings.count; ++k) {
    const int vertex = clothA.firstNode + clothA.mesh->vertices[toSize(m_meetings.parts[k])];
    const int(&face)[3] = clothB.mesh->faces[toSize(m_meetings.others[k])].node;
    m_pairs->vertexFace.push_back(
        {{vertex, clothB.firstNode + face[0], clothB.firstNode + face[1], clothB.firstNode + face[2]},
         {m_pairOfTiles[0], m_pairOfTiles[1]}});
  }
}

void GuardTiles::meetEdges(std::size_t a, std::size_t b) {
  const Cloth& clothA = m_bounds.cloths()[m_tiles[a].cloth];
  const Cloth& clothB = m_bounds.cloths()[m_tiles[b].cloth];
  PartBoxes::meetEdges(m_chosen[0][PartBoxes::kEdges], m_chosen[1][PartBoxes::kEdges], a == b, m_areOnlyNew,
                       m_meetings);
  for (std::size_t k = 0; k < m_meetings.count; ++k) {
    const int(&edge)[2] = clothA.mesh->edges[toSize(m_meetings.parts[k])].node;
    const int(&across)[2] = clothB.mesh->edges[toSize(m_meetings.others[k])].node;
    m_pairs->edgeEdge.push_back({{clothA.firstNode + edge[0], clothA.firstNode + edge[1], clothB.firstNode + across[0],
                                  clothB.firstNode + across[1]},
                                 {m_pairOfTiles[0], m_pairOfTiles[1]}});
  }
}

// Two that may meet: of their quarters those that may.
void GuardTiles::lookAtSquares(const Cloth& a, const Square& squareA, const Cloth& b, const Square& squareB) {
  const GuardGrid gridA = {*a.mesh};
  const GuardGrid gridB = {*b.mesh};
  if (squareA.level == GuardGrid::kCells) {
    return lookAtCells(a, gridA.cellAt(squareA.row, squareA.column), b, gridB.cellAt(squareB.row, squareB.column));
  }
  const int level = squareA.level + 1;
  const bool isSelf = &a == &b;
  const bool isOne = isSelf && squareA.row == squareB.row && squareA.column == squareB.column;
  const GuardBox& whole = m_bounds.square(b, squareB.level, squareB.row, squareB.column);
  const GridRectangle inA = gridA.squaresIn(squareA.level, squareA.row, squareA.column, level);
  const GridRectangle inB = gridB.squaresIn(squareB.level, squareB.row, squareB.column, level);
  for (int rowA = inA.firstRow; rowA <= inA.lastRow; ++rowA) {
    for (int columnA = inA.firstColumn; columnA <= inA.lastColumn; ++columnA) {
      const GuardBox& box = m_bounds.square(a, level, rowA, columnA);
      if (!box.overlaps(whole)) continue;
      for (int rowB = isOne ? rowA : inB.firstRow; rowB <= inB.lastRow; ++rowB) {
        for (int columnB = isOne && rowB == rowA ? columnA : inB.firstColumn; columnB <= inB.lastColumn; ++columnB) {
          if (!box.overlaps(m_bounds.square(b, level, rowB, columnB))) continue;
          if (isSelf && m_bounds.areFlat(a, level, GridRectangle::around(rowA, columnA, rowB, columnB))) continue;
          lookAtSquares(a, {level, rowA, columnA}, b, {level, rowB, columnB});
        }
      }
    }
  }
}

void GuardTiles::lookAtCells(const Cloth& a, int cellA, const Cloth& b, int cellB) {
  const bool isOne = &a == &b && cellA == cellB;
  m_bounds.boundParts(a, cellA);
  m_bounds.boundParts(b, cellB);
  verticesAndFaces(a, cellA, b, cellB);
  if (!isOne) verticesAndFaces(b, cellB, a, cellA);
  const GuardMesh::Cell& beginA = a.mesh->cells[toSize(cellA)];
  const GuardMesh::Cell& endA = a.mesh->cells[toSize(cellA) + 1];
  const GuardMesh::Cell& beginB = b.mesh->cells[toSize(cellB)];
  const GuardMesh::Cell& endB = b.mesh->cells[toSize(cellB) + 1];
  for (int i = beginA.edge; i < endA.edge; ++i) {
    const GuardMesh::Edge& edge = a.mesh->edges[toSize(i)];
    for (int k = isOne ? i + 1 : beginB.edge; k < endB.edge; ++k) {
      if (!m_bounds.edge(a, i).overlaps(m_bounds.edge(b, k))) continue;
      const GuardMesh::Edge& other = b.mesh->edges[toSize(k)];
      add<2>({{a.firstNode + edge.node[0], a.firstNode + edge.node[1], b.firstNode + other.node[0],
               b.firstNode + other.node[1]},
              {m_pairOfTiles[0], m_pairOfTiles[1]}},
             m_pairs->edgeEdge);
    }
  }
}

// Parts that share a node are no pair.
template <int first>
void GuardTiles::add(const GuardPair& pair, std::vector<GuardPair>& pairs) const {
  for (int i = 0; i < first; ++i) {
    for (int k = first; k < 4; ++k) {
      if (pair.node[i] == pair.node[k]) return;
    }
  }
  pairs.push_back(pair);
}

// The vertices of a cell and the faces of another.
void GuardTiles::verticesAndFaces(const Cloth& a, int cellA, const Cloth& b, int cellB) {
  const GuardMesh::Cell& beginA = a.mesh->cells[toSize(cellA)];
  const GuardMesh::Cell& endA = a.mesh->cells[toSize(cellA) + 1];
  const GuardMesh::Cell& beginB = b.mesh->cells[toSize(cellB)];
  const GuardMesh::Cell& endB = b.mesh->cells[toSize(cellB) + 1];
  for (int i = beginA.vertex; i < endA.vertex; ++i) {
    const int vertex = a.mesh->vertices[toSize(i)];
    const GuardBox box = m_bounds.vertex(a, vertex);
    for (int k = beginB.face; k < endB.face; ++k) {
      if (!box.overlaps(m_bounds.face(b, k))) continue;
      const GuardMesh::Face& face = b.mesh->faces[toSize(k)];
      add<1>(
          {{a.firstNode + vertex, b.firstNode + face.node[0], b.firstNode + face.node[1], b.firstNode + face.node[2]},
           {m_pairOfTiles[0], m_pairOfTiles[1]}},
          m_pairs->vertexFace);
    }
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
