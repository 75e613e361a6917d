// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Triangles in an order in which a processor works on several at once.
///
/// In a regular mesh most triangles have a neighbour whose three nodes are each the next in number. Such triangles make
/// a run: their corners are three stretches of the nodes' arrays, and nothing need be gathered. What belongs to no run
/// makes blocks whose corners are gathered one by one.
class TriangleBlocks {
 public:
  /// Triangles in a block, at most.
  static constexpr std::size_t kSize = 64;
  /// Blocks are filled up to a multiple of this.
  static constexpr std::size_t kLanes = 8;

  /// Its nodes.
  using Triangle = std::array<int, 3>;

  /// Lane k of a run has the corners first[0] + k, first[1] + k, first[2] + k; those of other blocks are listed.
  struct Block {
    std::size_t lanes;      ///< a multiple of kLanes, at most kSize
    std::size_t firstLane;  ///< of the block, among those of all blocks
    Triangle first;         ///< of a run
    bool isRun;             ///< whether the corners follow from `first`
  };

  /// Sorts these triangles, of which no two are the same, into blocks.
  void reset(std::vector<Triangle> triangles);

  /// In which the triangles are.
  const std::vector<Block>& blocks() const { return m_blocks; }
  /// Whether there is a triangle in a lane: 1, or 0.
  const btScalar* isTaken(const Block& block) const { return m_isTaken.data() + block.firstLane; }
  /// The corners of a lane that is taken; and of one that is not, in a block that is no run, corners that exist.
  Triangle corners(const Block& block, std::size_t lane) const;

 private:
  void addRun(const std::vector<Triangle>& triangles, std::size_t first, std::size_t end);
  void addGathered(const std::vector<Triangle>& triangles);
  void open(std::size_t lanes, const Triangle& first, bool isRun);

  std::vector<Block> m_blocks;
  std::vector<btScalar> m_isTaken;
  std::vector<Triangle> m_listed;  // of the blocks that are no runs, which come last
  std::size_t m_firstListed = 0;   // lane
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
