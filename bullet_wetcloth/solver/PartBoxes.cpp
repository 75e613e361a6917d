// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/PartBoxes.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/BestLanes.h"
#include "bullet_wetcloth/numerics/Quad.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

PartBoxes::Bounds boundsOf(const GuardBox& box) {
  PartBoxes::Bounds bounds;
  store(bounds.low, box.low);
  store(bounds.high, box.high);
  return bounds;
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

// Bits of the parts of a block that have one of these nodes.
template <class Lanes>
WETCLOTH_INLINE unsigned sharing(const PartBoxes::Block& block, const int (&nodes)[3]) {
  using Numbers = decltype(Lanes() > Lanes());
  unsigned bits = 0;
  if constexpr (kLaneCount<Lanes> != 1 && sizeof(btScalar) == sizeof(int)) {
    for (std::size_t k = 0; k < PartBoxes::kLanes; k += kLaneCount<Lanes>) {
      Numbers areSame = {};
      for (const auto& of : block.node) {
        Numbers number;
        std::memcpy(&number, of + k, sizeof number);
        areSame |= (number == nodes[0]) | (number == nodes[1]) | (number == nodes[2]);
      }
      bits |= bitsOfLanes<Lanes>(areSame) << k;
    }
  } else {
    for (const auto& of : block.node) {
      for (unsigned k = 0; k < PartBoxes::kLanes; ++k) {
        bits |= of[k] == nodes[0] || of[k] == nodes[1] || of[k] == nodes[2] ? 1u << k : 0u;
      }
    }
  }
  return bits;
}

int partOf(const GuardMesh::Cell& cell, PartBoxes::Kind kind) {
  return kind == PartBoxes::kVertices ? cell.vertex : kind == PartBoxes::kEdges ? cell.edge : cell.face;
}

}  // namespace

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
  GuardBox& box = m_nodeBoxes[toSize(node)];
  box.low = lesser(start, end) - around;
  box.high = greater(start, end) + around;
}

GuardBox PartBoxes::bound(std::size_t index) {
  Tile& tile = m_tiles[index];
  const GuardMesh& mesh = *tile.mesh;
  tile.isBound = 1;
  for (std::size_t k = tile.firstBlock[kVertices]; k < tile.firstBlock[kEdges]; ++k) {
    boundBlock<1>(m_blocks[k], tile.firstNode, [&](int part) { return &mesh.vertices[toSize(part)]; });
  }
  for (std::size_t k = tile.firstBlock[kEdges]; k < tile.firstBlock[kFaces]; ++k) {
    boundBlock<2>(m_blocks[k], tile.firstNode, [&](int part) { return mesh.edges[toSize(part)].node; });
  }
  GuardBox all;
  for (std::size_t k = tile.firstBlock[kFaces]; k < tile.firstBlock[kKinds]; ++k) {
    boundBlock<3>(m_blocks[k], tile.firstNode, [&](int part) { return mesh.faces[toSize(part)].node; });
    GuardBox faces;
    faces.low = load<Quad>(m_blocks[k].all.low);
    faces.high = load<Quad>(m_blocks[k].all.high);
    all.include(faces);
  }
  m_newTiles.push_back(index);
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

struct PartBoxes::Meeter {
  const ChosenParts& parts;
  const ChosenParts& others;
  bool newOnly;
  Meeting* meetings;  // room for all
  std::size_t& count;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    Meeting* next = meetings;
    for (const Chosen& own : parts) {
      for (const Chosen& other : others) {
        if (overlap(own.block->all, other.block->all)) next = meet<Lanes>(own, other, next);
      }
    }
    count = static_cast<std::size_t>(next - meetings);
  }

 private:
  template <class Lanes>
  WETCLOTH_INLINE Meeting* meet(const Chosen& own, const Chosen& other, Meeting* next) const {
    const Block& block = *own.block;
    const Block& across = *other.block;
    unsigned left = SpreadBox<Lanes>(across.all).overlapping(block) & own.parts;
    for (; left != 0; left &= left - 1) {
      const unsigned k = lowestBit(left);
      const bool areAllWanted = !newOnly || (block.isNew >> k & 1) != 0;
      const unsigned wanted = areAllWanted ? other.parts : other.parts & across.isNew;
      unsigned bits = SpreadBox<Lanes>(block, k).overlapping(across) & wanted;
      if (bits == 0) continue;
      bits &= ~sharing<Lanes>(across, {block.node[0][k], block.node[1][k], block.node[2][k]});
      for (; bits != 0; bits &= bits - 1) {
        *next++ = {block.first + static_cast<int>(k), across.first + static_cast<int>(lowestBit(bits))};
      }
    }
    return next;
  }
};

std::size_t PartBoxes::meet(const ChosenParts& parts, const ChosenParts& others, bool newOnly,
                            std::vector<Meeting>& meetings) {
  const std::size_t room = parts.size() * others.size() * kLanes * kLanes + 1;
  if (meetings.size() < room) meetings.resize(room);
  std::size_t count = 0;
  runOnBestLanes(Meeter{parts, others, newOnly, meetings.data(), count});
  return count;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
