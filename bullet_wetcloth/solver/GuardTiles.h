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

/// Finds the pairs of parts that may meet while every node keeps to where it is expected: k small steps from now within
/// a distance, on each axis, of its place then if it goes on as in this small step.
///
/// Tiles of cells whose boxes overlap are taken for a pair, unless they lie in a rectangle of a grid that is not bent
/// enough to meet itself (SheetBounds); then cells in the same way, and then parts.
class GuardTiles {
 public:
  /// What is expected: for so many small steps, the present one included, within so much [m] on each axis. Parts that
  /// come nearer than `near` [m] are looked for, too.
  struct Expectation {
    int steps;
    btScalar slack;
    btScalar near;
  };
  /// Which pairs; those with rigid bodies are wanted where there are any.
  struct Scope {
    bool self;
    bool others;
  };

  /// Forgets all cloths.
  void clear();
  /// A cloth whose nodes begin with this one.
  void add(const GuardMesh& mesh, std::size_t firstNode);
  /// Appends the pairs. A pair whose parts share a node is none.
  void findPairs(const GuardNodes& nodes, const Expectation& expectation, const Scope& scope, GuardCandidates& pairs);

 private:
  struct Cloth {
    const GuardMesh* mesh;
    int firstNode;
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

  bool isWanted(const Scope& scope, std::size_t tileA, std::size_t tileB) const;
  void findEnds();
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
  void boundCells(std::size_t tile);
  bool isFlat(const Cloth& cloth) const;
  bool isFlat(const Cloth& cloth, int tileA, int tileB) const;
  bool areCellsFlat(const Cloth& cloth, int cellA, int cellB);
  void lookAtTiles(std::size_t a, std::size_t b);
  void lookAtCells(const Cloth& a, int cellA, const Cloth& b, int cellB);
  void verticesAndFaces(const Cloth& a, int cellA, const Cloth& b, int cellB);
  GuardBox boxOfEdge(const Cloth& cloth, int edge) const;
  GuardBox boxOfFace(const Cloth& cloth, int face) const;

  std::vector<Cloth> m_cloths;
  std::vector<Tile> m_tiles;
  std::vector<GuardNodes::Place> m_ends;
  std::vector<bool> m_isFlat;          // of each cloth
  std::vector<GuardBox> m_boxes;       // of tiles
  std::vector<SheetBounds> m_vectors;  // of tiles
  std::vector<GuardBox> m_edgeBoxes;
  std::vector<GuardBox> m_faceBoxes;
  std::vector<GuardBox> m_cellBoxes;
  std::vector<SheetBounds> m_cellVectors;
  std::vector<bool> m_cellsAreBound;  // of tiles
  std::vector<Quarter> m_quarters;
  const GuardNodes* m_nodes = nullptr;
  Expectation m_expectation = {};
  GuardCandidates* m_pairs = nullptr;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
