// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/NodeSlots.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/solver/GridLink.h"

#include <algorithm>
#include <map>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr std::size_t kCandidates = 8;  // numbers of columns to try
constexpr double kShareOfGrid = 0.9;    // of the links, that make a mesh a grid
constexpr int kNodesInTile = 16384;     // about: large enough for a thread to pay
constexpr std::size_t kClassesSize = NodeSlots::kClasses;

std::size_t roundUp(std::size_t size) { return (size + NodeSlots::kLanes - 1) / NodeSlots::kLanes * NodeSlots::kLanes; }
std::size_t quarter(int count) { return (toSize(count) + kClassesSize - 1) / kClassesSize; }

// In a grid, links to the next row are the most frequent but for those along a row.
std::vector<int> candidateColumns(const btSoftBody& body) {
  std::map<int, int> counts;
  for (int k = 0; k < body.m_links.size(); ++k) {
    const btSoftBody::Link& link = body.m_links[k];
    ++counts[std::abs(nodeIndex(body, link.m_n[0]) - nodeIndex(body, link.m_n[1]))];
  }
  std::vector<std::pair<int, int>> frequent;
  for (const auto& [difference, count] : counts) frequent.emplace_back(-count, difference);
  std::sort(frequent.begin(), frequent.end());
  std::vector<int> columns = {body.m_nodes.size()};  // one row
  for (const auto& [count, difference] : frequent) {
    if (columns.size() < kCandidates && difference > 1) columns.push_back(difference);
  }
  return columns;
}

int linksInGrid(const btSoftBody& body, int columns) {
  int count = 0;
  for (int k = 0; k < body.m_links.size(); ++k) {
    const btSoftBody::Link& link = body.m_links[k];
    if (gridLink(nodeIndex(body, link.m_n[0]), nodeIndex(body, link.m_n[1]), columns)) ++count;
  }
  return count;
}

// 0: none.
int findColumns(const btSoftBody& body) {
  int best = 0;
  int most = static_cast<int>(kShareOfGrid * body.m_links.size());
  for (const int columns : candidateColumns(body)) {
    const int count = linksInGrid(body, columns);
    if (count <= most) continue;
    most = count;
    best = columns;
  }
  return best;
}

// As many as make tiles of about the same size.
int rowsOfTile(int rows, int columns) {
  const int tiles = std::max(1, rows * columns / kNodesInTile);
  const int quarters = (rows + tiles * NodeSlots::kClasses - 1) / (tiles * NodeSlots::kClasses);
  return quarters * NodeSlots::kClasses;
}

// Around each block there is room for a row and a column, so that a stretch of one block never ends in another.
NodeSlots::Grid gridOf(int nodes, int columns) {
  NodeSlots::Grid grid = {};
  grid.columns = columns;
  grid.rows = (nodes + columns - 1) / columns;
  grid.tileRows = rowsOfTile(grid.rows, columns);
  grid.blockColumns = quarter(columns);
  const std::size_t room = roundUp(grid.blockColumns + 1 + NodeSlots::kLanes);
  grid.blockSize = roundUp(grid.blockColumns * quarter(grid.tileRows)) + room;
  grid.first = room;
  grid.tileSize = room + kClassesSize * kClassesSize * grid.blockSize;
  return grid;
}

}  // namespace

NodeSlots findSlots(const btSoftBody& body) {
  NodeSlots slots;
  const int nodes = body.m_nodes.size();
  slots.ofNode.resize(toSize(nodes));
  const int columns = findColumns(body);
  if (columns == 0) {
    for (int k = 0; k < nodes; ++k) slots.ofNode[toSize(k)] = k;
    slots.count = roundUp(toSize(nodes));
    return slots;
  }
  slots.grid = gridOf(nodes, columns);
  for (int k = 0; k < nodes; ++k) slots.ofNode[toSize(k)] = static_cast<int>(slotInGrid(*slots.grid, k));
  slots.tiles = toSize(slots.grid->tiles());
  slots.count = slots.tiles * slots.grid->tileSize;
  return slots;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
