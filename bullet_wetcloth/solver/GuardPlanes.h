// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/bullet/PackedNodes.h"
#include "bullet_wetcloth/numerics/Quad.h"
#include "bullet_wetcloth/solver/GuardNodes.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Planes between pairs of one kind, in blocks that a processor measures at once.
///
/// Between two parts the gap along a plane's normal is what is left between their nearest nodes: positive, each part is
/// on its side. The places are the two that were nearest when the plane was made: means of the nodes by weights.
class GuardPlanes {
 public:
  /// How many planes are in a block; the last block may have less.
  static constexpr std::size_t kAtOnce = 8;

  /// A plane as it is made.
  struct Plane {
    GuardPair pair;
    btScalar normal[3];
    btScalar weights[4];  ///< of the first part's nodes, and minus those of the second's; their sum is 0
    btScalar gap;         ///< [m]
    btScalar apart;       ///< the two places, along the normal [m]
  };

  /// @param first  how many nodes are of the first part, in all pairs
  explicit GuardPlanes(int first) : m_first(first) {}

  void clear();
  void add(const Plane& plane);
  /// Puts another plane in the place of this one, between the same parts.
  void set(std::size_t index, const Plane& plane);
  GuardPair pair(std::size_t plane) const {
    return {{node(plane, 0), node(plane, 1), node(plane, 2), node(plane, 3)}, {tile(plane, 0), tile(plane, 1)}};
  }
  std::size_t size() const { return m_size; }
  int first() const { return m_first; }

  int node(std::size_t plane, int which) const { return blockOf(plane).node[which][plane % kAtOnce]; }
  /// The tile in which a part was found.
  int tile(std::size_t plane, int part) const { return m_tiles[plane].of[part]; }
  btScalar weight(std::size_t plane, int which) const { return blockOf(plane).weight[which][plane % kAtOnce]; }
  btVector3 normal(std::size_t plane) const {
    const Block& block = blockOf(plane);
    const std::size_t k = plane % kAtOnce;
    return btVector3(block.normal[0][k], block.normal[1][k], block.normal[2][k]);
  }
  /// At the end of the small step before [m].
  btScalar gap(std::size_t plane) const { return m_kept[plane / kAtOnce].gap[plane % kAtOnce]; }
  btScalar apart(std::size_t plane) const { return m_kept[plane / kAtOnce].apart[plane % kAtOnce]; }

  /// Of the planes of a block. What a block that is not full lacks is infinitely far apart.
  struct Measure {
    btScalar gap[kAtOnce];
    btScalar apart[kAtOnce];
  };
  /// Bit k tells that plane k's gap is less than one distance, or its places are nearer than another.
  static unsigned below(const Measure& measure, btScalar gap, btScalar apart) {
    unsigned above = 0;
    for (std::size_t k = 0; k < kAtOnce; k += 4) {
      above |= bitsOf((load<Quad>(measure.gap + k) >= everywhere<Quad>(gap)) &
                      (load<Quad>(measure.apart + k) >= everywhere<Quad>(apart)))
               << k;
    }
    return ~above & ((1u << kAtOnce) - 1);
  }
  std::size_t blocks() const { return m_blocks.size(); }
  const Measure& kept(std::size_t block) const { return m_kept[block]; }
  /// Where the nodes are at these places. measured() remembers it.
  const Measure& measure(std::size_t block, const std::vector<GuardNodes::Place>& at);
  const Measure& measured(std::size_t block) const { return m_measured[block]; }
  /// What all blocks were measured last are now those of the small step before.
  void keep();

  /// The same of one plane, and which of the first and of the second part's nodes are nearest.
  struct Nearest {
    btScalar gap;
    btScalar apart;
    int low;
    int high;
  };
  Nearest nearest(std::size_t plane, const std::vector<GuardNodes::Place>& at) const;

  /// Takes out planes; what was measured is forgotten. @param isKept  called with each one's number
  template <class IsKept>
  std::size_t filter(const IsKept& isKept) {
    std::size_t kept = 0;
    for (std::size_t plane = 0; plane < m_size; ++plane) {
      if (!isKept(plane)) continue;
      if (kept != plane) copy(plane, kept);
      ++kept;
    }
    const std::size_t gone = m_size - kept;
    if (gone > 0) truncate(kept);
    return gone;
  }

 private:
  struct Block {
    int node[4][kAtOnce];
    btScalar normal[3][kAtOnce];
    btScalar weight[4][kAtOnce];
  };
  struct Tiles {
    int of[2];
  };
  struct Gauge;

  const Block& blockOf(std::size_t plane) const { return m_blocks[plane / kAtOnce]; }
  void copy(std::size_t from, std::size_t to);
  void truncate(std::size_t size);

  int m_first;
  std::size_t m_size = 0;
  std::vector<Block> m_blocks;
  std::vector<Tiles> m_tiles;  // of each plane
  std::vector<Measure> m_kept;
  std::vector<Measure> m_measured;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
