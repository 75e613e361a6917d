// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/GuardBounds.h"
#include "bullet_wetcloth/solver/GuardMesh.h"
#include "bullet_wetcloth/solver/GuardNodes.h"
#include "bullet_wetcloth/solver/SupportPlanes.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Finds the pairs of parts that may meet while every node keeps to where it is expected.
///
/// Tiles of cells whose boxes overlap are taken for a pair, unless they lie in a rectangle of a grid that is not bent
/// enough to meet itself (GuardBounds); then their quarters in the same way, down to cells, and then parts.
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
  /// After these of the nodes are expected elsewhere: appends the pairs of which that may change something. What was
  /// found earlier of those that isLookedAtAgain() is void.
  void findPairsAgain(const std::vector<int>& changed, GuardCandidates& pairs);
  bool isLookedAtAgain(const GuardPair& pair) const;

 private:
  using Cloth = GuardBounds::Cloth;
  struct Tile {
    std::size_t cloth;
    int index;  // in the cloth's mesh
  };

  // Of a grid.
  struct Square {
    int level;
    int row;
    int column;
  };

  const GuardBox& boxOf(std::size_t tile) const {
    return m_bounds.tile(m_bounds.cloths()[m_tiles[tile].cloth], m_tiles[tile].index);
  }
  bool isWanted(std::size_t tileA, std::size_t tileB) const;
  bool areLookedAtAgain(int tileA, int tileB) const;
  bool goByNodes(std::size_t tileA, std::size_t tileB) const;
  bool hasNew(const GuardPair& pair) const;
  void markTilesOf(int node);
  void boundNewCells(std::size_t tile);
  void findStirredTiles();
  void findFlatCloths();
  void sortTiles();
  void findPairs();
  void lookAtPair(std::size_t one, std::size_t other);
  void lookAtNearTiles(std::size_t a, std::size_t b);
  bool areFlat(const Cloth& cloth, int tileA, int tileB);
  void lookAtTiles(std::size_t a, std::size_t b);
  void chooseParts(std::size_t a, std::size_t b);
  bool partsAreInFaces(std::size_t tile) const;
  void choosePartsNotBeyond(std::size_t tile, std::size_t bodies);
  void findCellsIn(std::size_t tile, const GuardBox& box, bool newOnly);
  bool isBeyond(std::size_t tile, int cell, std::size_t bodies);
  GuardBox boxOfCell(std::size_t tile, int cell);
  void choosePartsOfCells(std::size_t tile);
  void meetVerticesAndFaces(std::size_t a, int chosenA, std::size_t b, int chosenB);
  void meetEdges(std::size_t a, std::size_t b);
  void lookAtSquares(const Cloth& a, const Square& squareA, const Cloth& b, const Square& squareB);
  void lookAtCells(const Cloth& a, int cellA, const Cloth& b, int cellB);
  void verticesAndFaces(const Cloth& a, int cellA, const Cloth& b, int cellB);
  template <int first>
  void add(const GuardPair& pair, std::vector<GuardPair>& pairs) const;

  GuardBounds m_bounds;
  SupportPlanes m_planes;
  std::vector<std::size_t> m_firstTile;  // of each cloth
  std::vector<bool> m_isImposed;         // of each cloth
  std::vector<bool> m_isFlat;            // of each cloth
  std::vector<Tile> m_tiles;
  std::vector<bool> m_goesByNodes;     // of each cloth: pairs are looked at again that have a node of which that is so
  std::vector<bool> m_isNew;           // of each tile: what is expected of its nodes
  std::vector<GuardBox> m_newCells;    // of each tile that is new, where cloths go by nodes: around those that are
  std::vector<bool> m_isStirred;       // of each tile: what was found of it may be another
  std::vector<std::size_t> m_stirred;  // of m_sorted
  bool m_areAllNew = true;
  bool m_areOnlyNew = false;  // pairs with a new node are wanted, of two tiles
  std::vector<int> m_sorted;  // tiles, by where their boxes begin along an axis
  int m_axis = 0;
  using ChosenParts = PartBoxes::ChosenParts;
  ChosenParts m_chosen[2][PartBoxes::kKinds];  // of two tiles those that may meet
  std::vector<int> m_cells;                    // of the first of them
  PartBoxes::Meetings m_meetings;
  Scope m_scope = {};
  GuardCandidates* m_pairs = nullptr;
  int m_pairOfTiles[2] = {0, 0};  // that are looked at
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
