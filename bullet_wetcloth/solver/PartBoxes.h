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

/// Boxes of the vertices, edges and faces in tiles, each around the expected motion and grown by half of the distance
/// at which parts are near. Those of one kind in a tile stand in blocks, of which a processor tests all boxes at once.
class PartBoxes {
 public:
  enum Kind { kVertices, kEdges, kFaces, kKinds };
  static constexpr std::size_t kLanes = 8;
  /// A box as numbers: a Quad in memory is aligned otherwise where AVX2 is used.
  struct Bounds {
    btScalar low[4];
    btScalar high[4];
  };
  struct Block {
    btScalar low[3][kLanes];
    btScalar high[3][kLanes];
    int node[3][kLanes];  ///< among all nodes; those that a part of this kind does not have are its first
    Bounds all;           ///< around all of them
    int first;            ///< part of the mesh; the next lanes have the next ones, and empty boxes after the last
    unsigned count;       ///< of parts
    unsigned isNew;       ///< bit k: of the k-th one some node is
  };
  struct Blocks {
    const Block* begin;
    const Block* end;
  };
  /// Pairs of parts whose boxes overlap.
  struct Meetings {
    std::vector<int> parts;  ///< of each, and numbers that mean nothing after them
    std::vector<int> others;
    std::size_t count = 0;
  };
  /// Some of a tile's parts of one kind.
  struct Chosen {
    const Block* block;
    unsigned parts;  ///< bits
  };
  class ChosenParts {
   public:
    void clear() { m_count = 0; }
    bool isEmpty() const { return m_count == 0; }
    std::size_t size() const { return m_count; }
    /// What holds all parts of the blocks that they are in.
    GuardBox around() const;
    const Chosen* begin() const { return m_blocks.data(); }
    const Chosen* end() const { return m_blocks.data() + m_count; }
    /// Parts of one block come in turn.
    void add(const Block& block, unsigned parts) {
      if (m_count == 0 || m_blocks[m_count - 1].block != &block) {
        makeRoom(m_count + 1);
        m_blocks[m_count++] = {&block, 0};
      }
      m_blocks[m_count - 1].parts |= parts;
    }

   private:
    friend class PartBoxes;
    void makeRoom(std::size_t count) {
      if (m_blocks.size() < count) m_blocks.resize(2 * count);
    }
    std::vector<Chosen> m_blocks;
    std::size_t m_count = 0;
  };

  /// Forgets all tiles.
  void clear();
  /// The tiles of a mesh whose nodes begin with this one come after those that are there. It lives until clear().
  void add(const GuardMesh& mesh, int firstNode);
  /// All nodes are expected anew; they live as long as boxes are asked for. Parts are near at this distance [m].
  void begin(const GuardNodes& nodes, btScalar near);
  /// These nodes are expected elsewhere; those before them are new no more.
  void renew(const std::vector<int>& changed);
  bool isNew(int node) const { return m_isNewNode[static_cast<std::size_t>(node)] != 0; }
  /// Finds the boxes of a tile's parts, and returns what is around them. Before they are asked for.
  GuardBox bound(std::size_t tile);
  /// Its nodes are expected elsewhere.
  void forget(std::size_t tile) { m_tiles[tile].isBound = 0; }
  /// The same as bound(), if that has not been done.
  void need(std::size_t tile) {
    if (m_tiles[tile].isBound == 0) bound(tile);
  }
  Blocks blocks(std::size_t tile, Kind kind) const {
    return {m_blocks.data() + m_tiles[tile].firstBlock[kind], m_blocks.data() + m_tiles[tile].firstBlock[kind + 1]};
  }
  const GuardBox& vertex(int node) const { return m_nodeBoxes[static_cast<std::size_t>(node)]; }

  /// Of a tile's parts of one kind those whose boxes overlap this one.
  void find(std::size_t tile, Kind kind, const GuardBox& box, ChosenParts& chosen) const;
  /// For each of the vertices in turn those of the faces that do not have it and whose boxes overlap its own.
  /// @param newOnly  pairs of which one is new
  static void meetFaces(const ChosenParts& vertices, const ChosenParts& faces, bool newOnly, Meetings& meetings);
  /// The same for edges that share no node.
  /// @param areOfOne  both are those of one tile: each pair comes once, with the lower edge first
  static void meetEdges(const ChosenParts& edges, const ChosenParts& others, bool areOfOne, bool newOnly,
                        Meetings& meetings);

 private:
  struct Tile {
    const GuardMesh* mesh;
    int index;
    int firstNode;
    std::size_t firstBlock[kKinds + 1];
    unsigned char isBound;
  };
  struct Finder;
  template <int ownNodes, int otherNodes>
  struct Meeter;

  template <int ownNodes, int otherNodes>
  static void meet(const ChosenParts& parts, const ChosenParts& others, bool areOfOne, bool newOnly,
                   Meetings& meetings);

  void makeBlocks();
  void boundNode(int node);
  template <int count, class NodesOf>
  void boundBlock(Block& block, int firstNode, const NodesOf& nodesOf) const;

  std::vector<Tile> m_tiles;
  std::vector<Block> m_blocks;
  std::size_t m_blockCount = 0;  // of these; 0: not made yet
  std::vector<GuardBox> m_nodeBoxes;
  std::vector<unsigned char> m_isNewNode;
  std::vector<std::size_t> m_newTiles;  // that may have new parts
  const GuardNodes* m_nodes = nullptr;
  btScalar m_near = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
