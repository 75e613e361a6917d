// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/GuardGrid.h"
#include "bullet_wetcloth/solver/GuardMesh.h"
#include "bullet_wetcloth/solver/GuardNodes.h"
#include "bullet_wetcloth/solver/PartBoxes.h"
#include "bullet_wetcloth/solver/SheetBounds.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What holds the expected motion of the parts of cloths: boxes of tiles, of the squares of a grid down to its cells,
/// of edges and faces, each grown by half of the distance at which parts are near; and whether squares that are near
/// each other lie in a sheet that cannot meet itself. But for tiles they are found when they are asked for.
class GuardBounds {
 public:
  struct Cloth {
    const GuardMesh* mesh;
    int firstNode;
    int nodeCount;
    std::size_t firstSquare[GuardGrid::kLevels];  ///< of another mesh: tile; -, -, -
    std::size_t firstCell;
    std::size_t firstPatch;
    std::size_t firstEdge;
    std::size_t firstFace;
  };

  /// Forgets all cloths.
  void clear();
  /// A cloth whose nodes begin with this one.
  void add(const GuardMesh& mesh, std::size_t firstNode);
  const std::vector<Cloth>& cloths() const { return m_cloths; }

  /// All nodes are expected anew; they live as long as bounds are asked for. Parts are near at this distance [m].
  void boundTiles(const GuardNodes& nodes, btScalar near);
  /// These nodes are expected elsewhere. After that boundTile() for each of their tiles, then renewPatches().
  void renewNodes(const std::vector<int>& changed) {
    if (m_isAnyMesh) m_parts.renew(changed);
  }
  void boundTile(const Cloth& cloth, int tile);
  /// Of a mesh that is no grid: what is known of patches holds again, but for those that are flat no more.
  void renewPatches();

  const GuardBox& tile(const Cloth& cloth, int tile) const {
    return m_levels[0].squares[cloth.firstSquare[0] + toSize(tile)].box;
  }
  const GuardBox& square(const Cloth& cloth, int level, int row, int column) {
    return squareAt(cloth, level, row, column).box;
  }
  const GuardBox& cell(const Cloth& cloth, int row, int column) {
    return square(cloth, GuardGrid::kCells, row, column);
  }
  /// Of all tiles, where any cloth is no grid.
  PartBoxes& parts() { return m_parts; }
  const PartBoxes& parts() const { return m_parts; }
  /// Before a box of an edge or a face of this cell is asked for.
  void boundParts(const Cloth& cloth, int cell);
  const GuardBox& edge(const Cloth& cloth, int edge) const { return m_edges[cloth.firstEdge + toSize(edge)]; }
  const GuardBox& face(const Cloth& cloth, int face) const { return m_faces[cloth.firstFace + toSize(face)]; }
  GuardBox vertex(const Cloth& cloth, int node) const;

  /// Whether a whole cloth is one sheet that cannot meet itself.
  bool isFlat(const Cloth& cloth);
  /// Whether the squares of a rectangle of a grid are; those that are not near each other are not tried.
  bool areFlat(const Cloth& cloth, int level, const GridRectangle& squares);
  /// The same for what of a mesh that is no grid is in one of its patches.
  bool areInAFlatPatch(const Cloth& cloth, int tileA, int tileB);
  /// Whether they are in one that was flat before the last renewPatches(), and is no more.
  bool wereInAFlatPatch(const Cloth& cloth, int tileA, int tileB) const;
  bool isAnyPatchLost() const { return !m_lost.empty(); }
  static bool areNear(int level, const GridRectangle& squares) {
    return squares.reachesAtMost(level < GuardGrid::kCells ? 2 : 3);
  }

 private:
  // Of a grid; another mesh has boxes only.
  struct Square {
    GuardBox box;
    SheetBounds vectors;
  };
  // Of a patch: it was flat before nodes were expected elsewhere, or before the last renewPatches().
  enum class Flatness : unsigned char { unknown, flat, perhapsNot, wasFlat, lost };
  struct Level {
    std::vector<Square> squares;
    std::vector<unsigned char> isBound;
    std::vector<Flatness> four;  // squares: each with the next row and column
  };

  std::size_t indexOf(const Cloth& cloth) const { return static_cast<std::size_t>(&cloth - m_cloths.data()); }
  Square squareOf(const Cloth& cloth, const GridRectangle& nodes) const;
  GuardBox boxOf(const Cloth& cloth, const int* nodes, int count) const;
  const Square& squareAt(const Cloth& cloth, int level, int row, int column);
  struct PatchOf {
    std::size_t cloth;
    int patch;
  };
  static std::size_t patchOf(const Cloth& cloth, const GuardMesh::TileInPatch& both);
  bool doPatchesPay(const Cloth& cloth);
  bool isFirstPatchFlat(const Cloth& cloth, int tileA, int tileB);
  bool isFlat(const Cloth& cloth, const SheetPatch& patch);
  Flatness& flatnessOf(const PatchOf& of) { return m_patches[m_cloths[of.cloth].firstPatch + toSize(of.patch)]; }
  void findTile(const Cloth& cloth, int tile);
  void forgetSquaresOf(const Cloth& cloth, int tile);
  bool areFlatNow(const Cloth& cloth, int level, const GridRectangle& squares);
  static bool isWhole(const GuardGrid& grid, int level, int row, int column);

  std::vector<Cloth> m_cloths;
  Cloth m_end = {};  // of which nothing is there but where it would begin
  Level m_levels[GuardGrid::kLevels];
  PartBoxes m_parts;
  bool m_isAnyMesh = false;         // that is no grid
  std::vector<GuardBox> m_normals;  // of tiles
  std::vector<unsigned char> m_normalsAreBound;
  std::vector<unsigned char> m_patchesPay;  // of each cloth
  std::vector<Flatness> m_patches;
  std::vector<PatchOf> m_stirred;  // patches that were flat
  std::vector<PatchOf> m_lost;
  std::vector<GuardBox> m_edges;
  std::vector<GuardBox> m_faces;
  std::vector<unsigned char> m_partsAreBound;  // of cells
  const GuardNodes* m_nodes = nullptr;
  btScalar m_near = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
