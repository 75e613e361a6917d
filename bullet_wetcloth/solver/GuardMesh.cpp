// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardMesh.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/mesh/FaceWinding.h"
#include "bullet_wetcloth/mesh/RestMesh.h"
#include "bullet_wetcloth/solver/PartBoxes.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr int kMostFacesInTile = 32;

GuardMesh::Face nodesOf(const btSoftBody& body, int face) {
  const btSoftBody::Face& f = body.m_faces[face];
  return {{nodeIndex(body, f.m_n[0]), nodeIndex(body, f.m_n[1]), nodeIndex(body, f.m_n[2])}};
}

// Of a face: the row and column from which it reaches one row and one column further; -1: it reaches further.
struct GridCorner {
  int row;
  int column;
};

GridCorner gridCornerOf(const GuardMesh::Face& face, int columns) {
  GridCorner low = {face.node[0] / columns, face.node[0] % columns};
  GridCorner high = low;
  for (const int node : face.node) {
    low = {std::min(low.row, node / columns), std::min(low.column, node % columns)};
    high = {std::max(high.row, node / columns), std::max(high.column, node % columns)};
  }
  return high.row == low.row + 1 && high.column == low.column + 1 ? low : GridCorner{-1, -1};
}

// For each face, by its corner; empty when a face does not stand between two rows and columns.
std::vector<std::vector<int>> facesOfCorners(const btSoftBody& body, int columns) {
  std::vector<std::vector<int>> faces(toSize(body.m_nodes.size()));
  for (int k = 0; k < body.m_faces.size(); ++k) {
    const GridCorner corner = gridCornerOf(nodesOf(body, k), columns);
    if (corner.row < 0) return {};
    faces[toSize(corner.row * columns + corner.column)].push_back(k);
  }
  return faces;
}

// Puts parts into cells, one cell after the other.
class CellWriter {
 public:
  CellWriter(const btSoftBody& body, int columns, const std::vector<btVector3>& places, GuardMesh& mesh)
      : m_body(body),
        m_places(places),
        m_rest(body),
        m_mesh(mesh),
        m_hasVertex(toSize(body.m_nodes.size())),
        m_hasEdge(m_rest.edges().size()),
        m_isCorner(m_hasVertex.size()),
        m_edgesOfNode(m_hasVertex.size()),
        m_windings(faceWindings(m_rest)) {
    double sum = 0;
    for (const RestMesh::Edge& edge : m_rest.edges()) sum += edge.length;
    mesh.edgeLength = m_rest.edges().empty() ? 0 : sum / static_cast<double>(m_rest.edges().size());
    for (const RestMesh::Triangle& triangle : m_rest.triangles()) {
      for (const int node : triangle.nodes) m_isCorner[toSize(node)] = true;
    }
    for (std::size_t k = 0; k < m_rest.edges().size(); ++k) {
      const RestMesh::Edge& edge = m_rest.edges()[k];
      const int home = columns > 0 ? edge.a / columns * columns + std::min(edge.a % columns, edge.b % columns) : edge.a;
      m_edgesOfNode[toSize(home)].push_back(static_cast<int>(k));
    }
  }

  void beginCell(int row, int column) {
    m_mesh.cells.push_back({static_cast<int>(m_mesh.vertices.size()), static_cast<int>(m_mesh.edges.size()),
                            static_cast<int>(m_mesh.faces.size()), row, column});
  }
  void addVertex(int node) {
    if (m_hasVertex[toSize(node)] || !m_isCorner[toSize(node)]) return;
    m_hasVertex[toSize(node)] = true;
    m_mesh.vertices.push_back(node);
  }
  void addEdge(int index) {
    const RestMesh::Edge& edge = m_rest.edges()[toSize(index)];
    if (m_hasEdge[toSize(index)] || edge.a == edge.b) return;
    m_hasEdge[toSize(index)] = true;
    m_mesh.edges.push_back({{edge.a, edge.b}});
  }
  // Not one that has a node twice, nor one that is there already.
  bool isTriangle(int face) const {
    const auto& [a, b, c] = m_rest.triangles()[toSize(face)].nodes;
    return a != b && b != c && c != a && !m_rest.triangles()[toSize(face)].isDoubled;
  }
  // Of the body's faces those that are.
  std::vector<int> triangles() const {
    std::vector<int> faces;
    for (int face = 0; face < m_body.m_faces.size(); ++face) {
      if (isTriangle(face)) faces.push_back(face);
    }
    return faces;
  }
  void addFace(int face) {
    if (!isTriangle(face)) return;
    m_mesh.faces.push_back(nodesOf(m_body, face));
    if (m_mesh.isGrid()) return;
    const btScalar doubleArea =
        (placeOf(face, 1) - placeOf(face, 0)).cross(placeOf(face, 2) - placeOf(face, 0)).length();
    const btScalar winding = static_cast<btScalar>(m_windings[toSize(face)]);
    m_mesh.windings.push_back(doubleArea > 0 ? winding / doubleArea : 0);
  }
  void addFaceWithParts(int face) {
    for (const int node : m_rest.triangles()[toSize(face)].nodes) addVertex(node);
    for (const int edge : m_rest.triangles()[toSize(face)].edges) {
      if (edge >= 0) addEdge(edge);
    }
    addFace(face);
  }
  // Of its corners, thrice.
  btVector3 centreOf(int face) const { return placeOf(face, 0) + placeOf(face, 1) + placeOf(face, 2); }
  // Of a grid: those between this node's row and column and the next ones.
  void addEdgesFrom(int node) {
    for (const int edge : m_edgesOfNode[toSize(node)]) addEdge(edge);
  }

 private:
  const btVector3& placeOf(int face, std::size_t corner) const {
    return m_places[toSize(m_rest.triangles()[toSize(face)].nodes[corner])];
  }

  const btSoftBody& m_body;
  const std::vector<btVector3>& m_places;
  RestMesh m_rest;
  GuardMesh& m_mesh;
  std::vector<bool> m_hasVertex;
  std::vector<bool> m_hasEdge;
  std::vector<bool> m_isCorner;
  std::vector<std::vector<int>> m_edgesOfNode;
  std::vector<int> m_windings;
};

void fillGrid(const std::vector<std::vector<int>>& facesOfCorner, CellWriter& writer, GuardMesh& mesh) {
  constexpr int kSide = GuardMesh::kSide;
  mesh.tileColumns = (mesh.columns + kSide - 1) / kSide;
  mesh.tileRows = (mesh.rows + kSide - 1) / kSide;
  for (int tile = 0; tile < mesh.tileRows * mesh.tileColumns; ++tile) {
    const int firstRow = tile / mesh.tileColumns * kSide;
    const int firstColumn = tile % mesh.tileColumns * kSide;
    GuardMesh::Tile entry = {static_cast<int>(mesh.cells.size()), 0, true};
    for (int row = firstRow; row < std::min(firstRow + kSide, mesh.rows); ++row) {
      for (int column = firstColumn; column < std::min(firstColumn + kSide, mesh.columns); ++column) {
        const int node = row * mesh.columns + column;
        writer.beginCell(row, column);
        writer.addVertex(node);
        writer.addEdgesFrom(node);
        for (const int face : facesOfCorner[toSize(node)]) writer.addFace(face);
        const bool isInside = row + 1 < mesh.rows && column + 1 < mesh.columns;
        if (isInside && facesOfCorner[toSize(node)].size() != 2) entry.isWhole = false;
      }
    }
    entry.endCell = static_cast<int>(mesh.cells.size());
    mesh.tiles.push_back(entry);
  }
}

// Halves the faces along the longest side of where their centres are: the first half has a multiple of so many.
int* halve(int* first, int* last, std::ptrdiff_t multiple, const CellWriter& writer) {
  btVector3 least = writer.centreOf(*first);
  btVector3 largest = least;
  for (const int* face = first; face != last; ++face) {
    least.setMin(writer.centreOf(*face));
    largest.setMax(writer.centreOf(*face));
  }
  const int axis = (largest - least).maxAxis();
  int* const middle = first + std::max(((last - first) / 2 + multiple / 2) / multiple, std::ptrdiff_t(1)) * multiple;
  std::nth_element(first, middle, last, [&](int a, int b) {
    const btScalar atA = writer.centreOf(a)[axis];
    const btScalar atB = writer.centreOf(b)[axis];
    return atA != atB ? atA < atB : a < b;
  });
  return middle;
}

// So that those whose boxes are tested at once are near each other.
void sortFaces(int* first, int* last, const CellWriter& writer) {
  constexpr auto kAtOnce = static_cast<std::ptrdiff_t>(PartBoxes::kLanes);
  if (last - first <= kAtOnce) return;
  int* const middle = halve(first, last, kAtOnce, writer);
  sortFaces(first, middle, writer);
  sortFaces(middle, last, writer);
}

// Halves the faces until few are left.
void fillTiles(int* first, int* last, CellWriter& writer, GuardMesh& mesh) {
  if (last - first <= kMostFacesInTile) {
    GuardMesh::Tile tile = {static_cast<int>(mesh.cells.size()), 0, false};
    sortFaces(first, last, writer);
    for (const int* face = first; face != last; ++face) {
      writer.beginCell(0, 0);
      writer.addFaceWithParts(*face);
    }
    tile.endCell = static_cast<int>(mesh.cells.size());
    mesh.tiles.push_back(tile);
    return;
  }
  int* const middle = halve(first, last, kMostFacesInTile, writer);
  fillTiles(first, middle, writer, mesh);
  fillTiles(middle, last, writer, mesh);
}

// Calls action(node, tile) for the nodes of each tile; for some more than once.
template <class Action>
void forEachNodeOfTiles(const GuardMesh& mesh, const Action& action) {
  constexpr int kSide = GuardMesh::kSide;
  for (int tile = 0; tile < static_cast<int>(mesh.tiles.size()); ++tile) {
    if (mesh.isGrid()) {
      const int row = tile / mesh.tileColumns * kSide;
      const int column = tile % mesh.tileColumns * kSide;
      for (int i = row; i <= std::min(row + kSide, mesh.rows - 1); ++i) {
        for (int k = column; k <= std::min(column + kSide, mesh.columns - 1); ++k) action(i * mesh.columns + k, tile);
      }
      continue;
    }
    const GuardMesh::Cell& begin = mesh.cells[toSize(mesh.tiles[toSize(tile)].cell)];
    const GuardMesh::Cell& end = mesh.cells[toSize(mesh.tiles[toSize(tile)].endCell)];
    for (int face = begin.face; face < end.face; ++face) {
      for (const int node : mesh.faces[toSize(face)].node) action(node, tile);
    }
  }
}

}  // namespace

void GuardMesh::findTilesOfNodes(int nodeCount) {
  firstTileOfNode.assign(toSize(nodeCount), 0);
  forEachNodeOfTiles(*this, [&](int node, int) { ++firstTileOfNode[toSize(node)]; });
  int count = 0;
  for (int& first : firstTileOfNode) {
    const int end = count + first;  // if no tile came twice
    first = count;
    count = end;
  }
  endTileOfNode = firstTileOfNode;
  tilesOfNodes.resize(toSize(count));
  forEachNodeOfTiles(*this, [&](int node, int tile) {
    int& end = endTileOfNode[toSize(node)];
    if (end > firstTileOfNode[toSize(node)] && tilesOfNodes[toSize(end - 1)] == tile) return;
    tilesOfNodes[toSize(end++)] = tile;
  });
}

void GuardMesh::findPatches(const std::vector<btVector3>& places) {
  patches = sheetPatchesOf(*this, places);
  patchesTouched.resize(tiles.size());
  tilesInPatches.resize(tiles.size());
  std::vector<std::array<int, 3>> found;  // tile, other tile, patch
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const std::vector<int>& whole = patches[k].whole;
    for (const int tile : patches[k].tiles) patchesTouched[toSize(tile)].push_back(static_cast<int>(k));
    for (std::size_t i = 0; i < whole.size(); ++i) {
      for (std::size_t j = i; j < whole.size(); ++j) found.push_back({whole[i], whole[j], static_cast<int>(k)});
    }
  }
  std::sort(found.begin(), found.end());
  for (const auto& [tile, other, patch] : found) {
    std::vector<TileInPatch>& others = tilesInPatches[toSize(tile)];
    const int count = static_cast<int>(patchesOfTiles.size());
    if (others.empty() || others.back().tile != other) others.push_back({other, count, count});
    patchesOfTiles.push_back(patch);
    ++others.back().endPatch;
  }
}

const GuardMesh::TileInPatch* GuardMesh::inPatches(int tileA, int tileB) const {
  if (tilesInPatches.empty()) return nullptr;
  const std::vector<TileInPatch>& others = tilesInPatches[toSize(tileA)];
  const auto found = std::lower_bound(others.begin(), others.end(), tileB,
                                      [](const TileInPatch& other, int tile) { return other.tile < tile; });
  return found != others.end() && found->tile == tileB ? &*found : nullptr;
}

GuardMesh guardMeshOf(const btSoftBody& body, const std::optional<NodeSlots::Grid>& grid,
                      const std::vector<btVector3>& places) {
  GuardMesh mesh;
  const bool isFull = grid && grid->columns * grid->rows == body.m_nodes.size();
  const auto facesOfCorner = isFull ? facesOfCorners(body, grid->columns) : std::vector<std::vector<int>>();
  if (!facesOfCorner.empty()) {
    mesh.columns = grid->columns;
    mesh.rows = grid->rows;
  }
  CellWriter writer(body, mesh.columns, places, mesh);
  if (mesh.isGrid()) {
    fillGrid(facesOfCorner, writer, mesh);
  } else if (std::vector<int> order = writer.triangles(); !order.empty()) {
    fillTiles(order.data(), order.data() + order.size(), writer, mesh);
  }
  writer.beginCell(0, 0);
  mesh.findTilesOfNodes(body.m_nodes.size());
  mesh.findPatches(places);
  return mesh;
}

GuardMesh guardMeshOf(const btSoftBody& body, const std::optional<NodeSlots::Grid>& grid) {
  std::vector<btVector3> places;
  for (int k = 0; k < body.m_nodes.size(); ++k) places.push_back(body.m_nodes[k].m_x);
  return guardMeshOf(body, grid, places);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
