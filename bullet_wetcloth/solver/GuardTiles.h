// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/GuardMesh.h"
#include "bullet_wetcloth/solver/GuardNodes.h"
#include "bullet_wetcloth/solver/SheetBounds.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Finds the pairs of parts that may meet while every node keeps to where it is expected.
///
/// Tiles of cells whose boxes overlap are taken for a pair, unless they lie in a rectangle of a grid that is not bent
/// enough to meet itself (SheetBounds); then cells in the same way, and then parts.
class GuardTiles {
 public:
  /// Which pairs; those with rigid bodies are wanted where there are any.
  struct Scope {
    bool self;
    bool others;
  };

  /// Forgets all cloths.
  void clear();
  /// A cloth whose nodes begin with this one.
  /// @param isImposed  nothing moves it: it is no pair with itself, nor with another one that is
  void add(const GuardMesh& mesh, std::size_t firstNode, bool isImposed = false);
  /// Appends the pairs that may meet or come nearer than this [m]. A pair whose parts share a node is none.
  void findPairs(const GuardNodes& nodes, btScalar near, const Scope& scope, GuardCandidates& pairs);
  /// After these nodes are expected elsewhere: appends the pairs of all tiles of which that may change something. What
  /// was found earlier of two tiles that areLookedAtAgain() is void.
  void findPairsAgain(const GuardNodes& nodes, const std::vector<int>& changed, GuardCandidates& pairs);
  bool areLookedAtAgain(int tileA, int tileB) const;

 private:
  struct Cloth {
    const GuardMesh* mesh;
    int firstNode;
    int nodeCount;
    bool isImposed;
    std::size_t firstTile;
    std::size_t firstCell;
    std::size_t firstEdge;
    std::size_t firstFace;
    std::size_t firstQuarter;
  };
  struct Tile {
    std::size_t cloth;
    int index;  // in the cloth's mesh
  };
  // Rows and columns of a grid's nodes.
  struct Rectangle {
    int firstRow, lastRow;
    int firstColumn, lastColumn;
  };

  bool isWanted(std::size_t tileA, std::size_t tileB) const;
  void include(int node, GuardBox& box) const;
  void includeVector(int from, int to, GuardBox& box) const;
  Rectangle nodesOfTile(const GuardMesh& mesh, int tile) const;
  // Of half the side of a tile of a grid.
  struct Quarter {
    GuardBox box;
    SheetBounds vectors;
    bool isBound = false;
  };

  const Quarter& quarter(const Cloth& cloth, int row, int column);
  void lookAtQuarters(const Cloth& cloth, int tileA, int tileB);
  bool areQuartersFlat(const Cloth& cloth, const Rectangle& around);
  void lookAtNearCells(const Cloth& a, int cellA, const Cloth& b, int cellB);
  GuardBox boxOf(const Cloth& cloth, const Rectangle& nodes) const;
  SheetBounds vectorsOf(const Cloth& cloth, const Rectangle& nodes) const;
  void boundTile(std::size_t tile);
  void forgetBounds(std::size_t tile);
  void markTilesOf(int node);
  void findPairs();
  void sortTiles();
  void boundCells(std::size_t tile);
  bool isFlat(const Cloth& cloth) const;
  bool isFlat(const Cloth& cloth, int tileA, int tileB) const;
  bool areCellsFlat(const Cloth& cloth, int cellA, int cellB);
  bool areCellsFlat(const Cloth& cloth, const Rectangle& cells);
  void lookAtNearTiles(std::size_t a, std::size_t b);
  void lookAtTiles(std::size_t a, std::size_t b);
  void lookAtCells(const Cloth& a, int cellA, const Cloth& b, int cellB);
  void verticesAndFaces(const Cloth& a, int cellA, const Cloth& b, int cellB);
  GuardBox boxOfEdge(const Cloth& cloth, int edge) const;
  GuardBox boxOfFace(const Cloth& cloth, int face) const;

  std::vector<Cloth> m_cloths;
  std::vector<Tile> m_tiles;
  std::vector<bool> m_isFlat;  // of each cloth
  std::vector<bool> m_isNew;   // of each tile: what is expected of its nodes
  std::vector<int> m_sorted;   // tiles, by where their boxes begin along an axis
  int m_axis = 0;
  std::vector<GuardBox> m_boxes;       // of tiles
  std::vector<SheetBounds> m_vectors;  // of tiles
  std::vector<GuardBox> m_edgeBoxes;
  std::vector<GuardBox> m_faceBoxes;
  std::vector<GuardBox> m_cellBoxes;
  std::vector<SheetBounds> m_cellVectors;
  enum class Flatness : unsigned char { unknown, flat, perhapsNot };
  std::vector<Flatness> m_fourCells;  // of a grid, by node: the cells of two rows and columns that begin there
  std::vector<bool> m_cellsAreBound;  // of tiles
  std::vector<Quarter> m_quarters;
  const GuardNodes* m_nodes = nullptr;
  btScalar m_near = 0;
  Scope m_scope = {};
  GuardCandidates* m_pairs = nullptr;
  int m_pairOfTiles[2] = {0, 0};  // that are looked at
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
