// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/PartBoxes.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/BestLanes.h"
#include "bullet_wetcloth/numerics/Quad.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

PartBoxes::Bounds boundsOf(const GuardBox& box) {
  PartBoxes::Bounds bounds;
  store(bounds.low, box.low);
  store(bounds.high, box.high);
  return bounds;
}

GuardBox boxOf(const PartBoxes::Bounds& bounds) {
  GuardBox box;
  box.low = load<Quad>(bounds.low);
  box.high = load<Quad>(bounds.high);
  return box;
}

WETCLOTH_INLINE bool overlap(const PartBoxes::Bounds& a, const PartBoxes::Bounds& b) {
  constexpr unsigned kAxes = 7;
  return (bitsOf((load<Quad>(a.low) > load<Quad>(b.high)) | (load<Quad>(b.low) > load<Quad>(a.high))) & kAxes) == 0;
}

// Of as many boxes as there are lanes, from one of a block's on: bits of those that overlap this one.
template <class Lanes>
struct SpreadBox {
  Lanes low[3];
  Lanes high[3];

  WETCLOTH_INLINE explicit SpreadBox(const PartBoxes::Bounds& box) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = everywhere<Lanes>(box.low[axis]);
      high[axis] = everywhere<Lanes>(box.high[axis]);
    }
  }
  // Of the k-th part of a block.
  WETCLOTH_INLINE SpreadBox(const PartBoxes::Block& block, unsigned k) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = everywhere<Lanes>(block.low[axis][k]);
      high[axis] = everywhere<Lanes>(block.high[axis][k]);
    }
  }

  WETCLOTH_INLINE unsigned overlapping(const PartBoxes::Block& block) const {
    unsigned apart = 0;
    for (std::size_t k = 0; k < PartBoxes::kLanes; k += kLaneCount<Lanes>) {
      auto isApart = (low[0] > load<Lanes>(block.high[0] + k)) | (load<Lanes>(block.low[0] + k) > high[0]);
      for (std::size_t axis = 1; axis < 3; ++axis) {
        isApart =
            isApart | (low[axis] > load<Lanes>(block.high[axis] + k)) | (load<Lanes>(block.low[axis] + k) > high[axis]);
      }
      apart |= bitsOfLanes<Lanes>(isApart) << k;
    }
    return ~apart & ((1u << PartBoxes::kLanes) - 1);
  }
};

// Bits of the parts of a block, with so many nodes each, that have one of these.
template <class Lanes, int nodesOfPart, int count>
WETCLOTH_INLINE unsigned sharing(const PartBoxes::Block& block, const int (&nodes)[count]) {
  using Numbers = decltype(Lanes() > Lanes());
  unsigned bits = 0;
  if constexpr (kLaneCount<Lanes> != 1 && sizeof(btScalar) == sizeof(int)) {
    for (std::size_t k = 0; k < PartBoxes::kLanes; k += kLaneCount<Lanes>) {
      Numbers areSame = {};
      for (int i = 0; i < nodesOfPart; ++i) {
        Numbers number;
        std::memcpy(&number, block.node[i] + k, sizeof number);
        for (const int node : nodes) areSame |= number == node;
      }
      bits |= bitsOfLanes<Lanes>(areSame) << k;
    }
  } else {
    for (int i = 0; i < nodesOfPart; ++i) {
      for (unsigned k = 0; k < PartBoxes::kLanes; ++k) {
        for (const int node : nodes) bits |= block.node[i][k] == node ? 1u << k : 0u;
      }
    }
  }
  return bits;
}

// Of each number of eight bits, which of them are set, in turn.
struct BitsSet {
  struct Of {
    int bit[PartBoxes::kLanes] = {};
    std::size_t count = 0;
  };
  Of of[1u << PartBoxes::kLanes];

  constexpr BitsSet() : of() {
    for (unsigned bits = 0; bits < 1u << PartBoxes::kLanes; ++bits) {
      for (unsigned k = 0; k < PartBoxes::kLanes; ++k) {
        if ((bits >> k & 1) != 0) of[bits].bit[of[bits].count++] = static_cast<int>(k);
      }
    }
  }
};
constexpr BitsSet kBitsSet;

int partOf(const GuardMesh::Cell& cell, PartBoxes::Kind kind) {
  return kind == PartBoxes::kVertices ? cell.vertex : kind == PartBoxes::kEdges ? cell.edge : cell.face;
}

}  // namespace

GuardBox PartBoxes::ChosenParts::around() const {
  GuardBox box;
  for (const Chosen& chosen : *this) {
    const Block& block = *chosen.block;
    for (unsigned left = chosen.parts; left != 0; left &= left - 1) {
      const unsigned k = lowestBit(left);
      const Quad low = {block.low[0][k], block.low[1][k], block.low[2][k], 0};
      const Quad high = {block.high[0][k], block.high[1][k], block.high[2][k], 0};
      box.low = lesser(low, box.low);
      box.high = greater(high, box.high);
    }
  }
  return box;
}

void PartBoxes::clear() {
  m_tiles.clear();
  m_blockCount = 0;
}

void PartBoxes::add(const GuardMesh& mesh, int firstNode) {
  for (std::size_t k = 0; k < mesh.tiles.size(); ++k) m_tiles.push_back({&mesh, static_cast<int>(k), firstNode, {}, 0});
}

void PartBoxes::makeBlocks() {
  std::size_t count = 0;
  for (Tile& tile : m_tiles) {
    const GuardMesh& mesh = *tile.mesh;
    const GuardMesh::Tile& cells = mesh.tiles[toSize(tile.index)];
    for (int kind = 0; kind < kKinds; ++kind) {
      tile.firstBlock[kind] = count;
      const int first = partOf(mesh.cells[toSize(cells.cell)], static_cast<Kind>(kind));
      const int end = partOf(mesh.cells[toSize(cells.endCell)], static_cast<Kind>(kind));
      for (int part = first; part < end; part += static_cast<int>(kLanes)) {
        if (m_blocks.size() <= count) m_blocks.resize(2 * count + 1);
        m_blocks[count].first = part;
        m_blocks[count++].count = static_cast<unsigned>(std::min(end - part, static_cast<int>(kLanes)));
      }
    }
    tile.firstBlock[kKinds] = count;
  }
  m_blockCount = count;
}

void PartBoxes::begin(const GuardNodes& nodes, btScalar near) {
  m_nodes = &nodes;
  m_near = near;
  if (m_blockCount == 0) makeBlocks();
  for (Tile& tile : m_tiles) tile.isBound = 0;
  m_newTiles.clear();
  m_isNewNode.assign(nodes.expected.size(), 0);
  m_nodeBoxes.resize(nodes.expected.size());
  for (std::size_t node = 0; node < m_nodeBoxes.size(); ++node) boundNode(static_cast<int>(node));
}

void PartBoxes::renew(const std::vector<int>& changed) {
  std::fill(m_isNewNode.begin(), m_isNewNode.end(), static_cast<unsigned char>(0));
  for (const std::size_t tile : m_newTiles) {
    for (std::size_t k = m_tiles[tile].firstBlock[0]; k < m_tiles[tile].firstBlock[kKinds]; ++k) m_blocks[k].isNew = 0;
  }
  m_newTiles.clear();
  for (const int node : changed) {
    m_isNewNode[toSize(node)] = 1;
    boundNode(node);
  }
}

void PartBoxes::boundNode(int node) {
  const GuardNodes::Way& way = m_nodes->expected[toSize(node)];
  const Quad start = load<Quad>(way.start.at);
  const Quad end = load<Quad>(way.end.at);
  const Quad around = splat<3>(start) + everywhere<Quad>(m_near / 2);
  // Where a block has no part there is a box that only one without end overlaps.
  constexpr btScalar most = std::numeric_limits<btScalar>::max();
  GuardBox& box = m_nodeBoxes[toSize(node)];
  box.low = greater(lesser(start, end) - around, everywhere<Quad>(-most));
  box.high = lesser(greater(start, end) + around, everywhere<Quad>(most));
}

GuardBox PartBoxes::bound(std::size_t tile) {
  Tile& of = m_tiles[tile];
  const GuardMesh& mesh = *of.mesh;
  of.isBound = 1;
  for (std::size_t k = of.firstBlock[kVertices]; k < of.firstBlock[kEdges]; ++k) {
    boundBlock<1>(m_blocks[k], of.firstNode, [&](int part) { return &mesh.vertices[toSize(part)]; });
  }
  for (std::size_t k = of.firstBlock[kEdges]; k < of.firstBlock[kFaces]; ++k) {
    boundBlock<2>(m_blocks[k], of.firstNode, [&](int part) { return mesh.edges[toSize(part)].node; });
  }
  GuardBox all;
  for (std::size_t k = of.firstBlock[kFaces]; k < of.firstBlock[kKinds]; ++k) {
    boundBlock<3>(m_blocks[k], of.firstNode, [&](int part) { return mesh.faces[toSize(part)].node; });
    all.include(boxOf(m_blocks[k].all));
  }
  m_newTiles.push_back(tile);
  return all;
}

template <int count, class NodesOf>
void PartBoxes::boundBlock(Block& block, int firstNode, const NodesOf& nodesOf) const {
  block.isNew = 0;
  GuardBox all;
  for (std::size_t begin = 0; begin < kLanes; begin += 4) {
    GuardBox boxes[4];
    for (std::size_t k = 0; k < 4 && begin + k < block.count; ++k) {
      const int* const nodes = nodesOf(block.first + static_cast<int>(begin + k));
      for (int i = 0; i < 3; ++i) block.node[i][begin + k] = firstNode + nodes[i < count ? i : 0];
      for (int i = 0; i < count; ++i) {
        const std::size_t node = toSize(firstNode + nodes[i]);
        boxes[k].include(m_nodeBoxes[node]);
        block.isNew |= m_isNewNode[node] != 0 ? 1u << (begin + k) : 0u;
      }
      all.include(boxes[k]);
    }
    const Quad lows[4] = {boxes[0].low, boxes[1].low, boxes[2].low, boxes[3].low};
    const Quad highs[4] = {boxes[0].high, boxes[1].high, boxes[2].high, boxes[3].high};
    Quad low[4], high[4];
    transpose(lows, low);
    transpose(highs, high);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      store(block.low[axis] + begin, low[axis]);
      store(block.high[axis] + begin, high[axis]);
    }
  }
  block.all = boundsOf(all);
}

// --- which overlap --------------------------------------------------------------------------------------------------

struct PartBoxes::Finder {
  Blocks blocks;
  Bounds box;
  Chosen* chosen;
  std::size_t& count;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    const SpreadBox<Lanes> spread(box);
    for (const Block* block = blocks.begin; block != blocks.end; ++block) {
      if (!overlap(box, block->all)) continue;
      const unsigned bits = spread.overlapping(*block);
      chosen[count] = {block, bits};
      count += bits != 0 ? 1 : 0;
    }
  }
};

void PartBoxes::find(std::size_t tile, Kind kind, const GuardBox& box, ChosenParts& chosen) const {
  const Blocks all = blocks(tile, kind);
  chosen.makeRoom(static_cast<std::size_t>(all.end - all.begin) + 1);
  chosen.m_count = 0;
  runOnBestLanes(Finder{all, boundsOf(box), chosen.m_blocks.data(), chosen.m_count});
}

/// Of parts with so many nodes each.
template <int ownNodes, int otherNodes>
struct PartBoxes::Meeter {
  const ChosenParts& parts;
  const ChosenParts& others;
  bool areOfOne;  // tile: each pair once
  bool newOnly;
  Meetings& meetings;  // room for all

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    std::size_t count = 0;
    for (const Chosen& own : parts) {
      for (const Chosen& other : others) {
        if (areOfOne && other.block->first < own.block->first) continue;
        if (overlap(own.block->all, other.block->all)) count = meet<Lanes>(own, other, count);
      }
    }
    meetings.count = count;
  }

 private:
  template <class Lanes>
  WETCLOTH_INLINE std::size_t meet(const Chosen& own, const Chosen& other, std::size_t count) const {
    const Block& block = *own.block;
    const Block& across = *other.block;
    const bool areOneBlock = areOfOne && &block == &across;
    unsigned left = SpreadBox<Lanes>(across.all).overlapping(block) & own.parts;
    for (; left != 0; left &= left - 1) {
      const unsigned k = lowestBit(left);
      const bool areAllWanted = !newOnly || (block.isNew >> k & 1) != 0;
      unsigned wanted = areAllWanted ? other.parts : other.parts & across.isNew;
      if (areOneBlock) wanted &= ~0u << k;
      unsigned bits = SpreadBox<Lanes>(block, k).overlapping(across) & wanted;
      int nodes[ownNodes];
      for (int i = 0; i < ownNodes; ++i) nodes[i] = block.node[i][k];
      bits &= ~sharing<Lanes, otherNodes>(across, nodes);
      // All eight, without asking which: a processor does not foresee how many there are.
      const BitsSet::Of& set = kBitsSet.of[bits];
      int next[kLanes];
      for (int& part : next) part = block.first + static_cast<int>(k);
      std::memcpy(meetings.parts.data() + count, next, sizeof next);
      for (std::size_t i = 0; i < kLanes; ++i) next[i] = across.first + set.bit[i];
      std::memcpy(meetings.others.data() + count, next, sizeof next);
      count += set.count;
    }
    return count;
  }
};

template <int ownNodes, int otherNodes>
void PartBoxes::meet(const ChosenParts& parts, const ChosenParts& others, bool areOfOne, bool newOnly,
                     Meetings& meetings) {
  const std::size_t room = parts.size() * others.size() * kLanes * kLanes + kLanes;
  if (meetings.parts.size() < room) {
    meetings.parts.resize(room);
    meetings.others.resize(room);
  }
  runOnBestLanes(Meeter<ownNodes, otherNodes>{parts, others, areOfOne, newOnly, meetings});
}

void PartBoxes::meetFaces(const ChosenParts& vertices, const ChosenParts& faces, bool newOnly, Meetings& meetings) {
  meet<1, 3>(vertices, faces, false, newOnly, meetings);
}

void PartBoxes::meetEdges(const ChosenParts& edges, const ChosenParts& others, bool areOfOne, bool newOnly,
                          Meetings& meetings) {
  meet<2, 2>(edges, others, areOfOne, newOnly, meetings);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
