// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/NodeSlots.h"
#include "bullet_wetcloth/solver/SheetPatches.h"

#include <BulletSoftBody/btSoftBody.h>

#include <optional>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What of a cloth must not pass what: the vertices, edges and faces of its triangles. They stand in cells of a few and
/// tiles of some cells; each belongs to one cell, so that each pair is met once.
///
/// Of a grid a cell is that of a node: it has the node, the edges to the next ones and the two triangles between them.
/// Of another mesh it is a triangle with what no triangle before it has.
struct GuardMesh {
  struct Edge {
    int node[2];
  };
  struct Face {
    int node[3];
  };
  /// The first part of each kind; the next cell's are the ends.
  struct Cell {
    int vertex;
    int edge;
    int face;
    int row;     ///< of a grid
    int column;  ///< of a grid
  };
  struct Tile {
    int cell;      ///< the first one
    int endCell;   ///< after the last one
    bool isWhole;  ///< of a grid: has two triangles between all its rows and columns
  };
  struct TileInPatch {
    int tile;
    int firstPatch;  ///< of patchesOfTiles
    int endPatch;
  };
  /// Of a mesh of bodies: a convex one, or what of it is there.
  struct Shell {
    int node, endNode;
    int face, endFace;
  };
  /// Rows and columns of nodes in a tile of a grid.
  static constexpr int kSide = 8;

  std::vector<int> vertices;  ///< nodes
  std::vector<Edge> edges;
  std::vector<Face> faces;
  std::vector<Cell> cells;  ///< and one more after the last
  std::vector<Tile> tiles;  ///< of a grid: row by row
  std::vector<Shell> shells;
  std::vector<int> shellOfTile;  ///< of a mesh of bodies; -1: none
  /// Of each node: between which of tilesOfNodes the tiles are that have a face with it, and of a grid those whose
  /// rectangle has it.
  std::vector<int> firstTileOfNode;
  std::vector<int> endTileOfNode;
  std::vector<int> tilesOfNodes;
  /// Of each face of a mesh that is no grid: which way round its nodes are, as faceWindings(), over twice its area
  /// when the mesh was made [1/m^2]; 0 of one without area.
  std::vector<btScalar> windings;
  std::vector<SheetPatch> patches;               ///< of a mesh that is no grid
  std::vector<std::vector<int>> patchesTouched;  ///< of each tile, those that have any of its faces
  /// Of each tile: it and later ones that have all of their faces in one patch with all of its faces, sorted.
  std::vector<std::vector<TileInPatch>> tilesInPatches;
  std::vector<int> patchesOfTiles;  ///< of these, one after the other
  int columns = 0;                  ///< of nodes in a grid; 0: it is none
  int rows = 0;
  int tileColumns = 0;
  int tileRows = 0;
  double edgeLength = 0;    ///< mean at rest [m]
  bool isOfBodies = false;  ///< of rigid ones, which nobody keeps from each other

  /// Finds the tiles of so many nodes.
  void findTilesOfNodes(int nodeCount);
  /// Finds the patches, where nodes are at these places [m].
  void findPatches(const std::vector<btVector3>& places);

  /// Of two tiles, sorted; null: no patch has all faces of both.
  const TileInPatch* inPatches(int tileA, int tileB) const;

  bool isGrid() const { return columns > 0; }
};

/// Of this body; its slots tell whether it is a grid.
/// @param places  of its nodes, by which a mesh that is no grid is divided [m]
GuardMesh guardMeshOf(const btSoftBody& body, const std::optional<NodeSlots::Grid>& grid,
                      const std::vector<btVector3>& places);
/// By where they are.
GuardMesh guardMeshOf(const btSoftBody& body, const std::optional<NodeSlots::Grid>& grid);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
