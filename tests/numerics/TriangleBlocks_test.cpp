// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/TriangleBlocks.h"

#include "bullet_wetcloth/bullet/PackedNodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

namespace wetcloth_test::triangle_blocks_test {
namespace {

using wetcloth::TriangleBlocks;
using Triangle = TriangleBlocks::Triangle;

// From its smallest node on, the same way round.
Triangle turned(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

std::vector<Triangle> grid(int columns, int rows) {
  std::vector<Triangle> triangles;
  for (int j = 0; j + 1 < rows; ++j) {
    for (int i = 0; i + 1 < columns; ++i) {
      const int node = j * columns + i;
      triangles.push_back({node + columns, node, node + 1});
      triangles.push_back({node + 1, node + columns + 1, node + columns});
    }
  }
  return triangles;
}

// Of no regularity, and no two of the same nodes.
std::vector<Triangle> scattered(int nodes, int count) {
  std::set<Triangle> found;
  unsigned seed = 7;
  const auto next = [&] { return static_cast<int>((seed = seed * 1664525 + 1013904223) >> 8) % nodes; };
  while (static_cast<int>(found.size()) < count) {
    const Triangle t = {next(), next(), next()};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) found.insert(turned(t));
  }
  return {found.begin(), found.end()};
}

void expectEachOnce(const std::vector<Triangle>& triangles, int nodes) {
  TriangleBlocks blocks;
  blocks.reset(triangles);
  std::multiset<Triangle> found;
  std::size_t lanes = 0;
  for (const TriangleBlocks::Block& block : blocks.blocks()) {
    ASSERT_LE(block.lanes, TriangleBlocks::kSize);
    ASSERT_EQ(block.lanes % TriangleBlocks::kLanes, 0u);
    ASSERT_EQ(block.firstLane, lanes);
    lanes += block.lanes;
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
      const Triangle corners = blocks.corners(block, lane);
      const int last = *std::max_element(corners.begin(), corners.end());
      ASSERT_LT(last, nodes + static_cast<int>(wetcloth::PackedNodes::kPadding));
      ASSERT_TRUE(block.isRun || last < nodes);
      if (blocks.isTaken(block)[lane] > 0) found.insert(turned(corners));
    }
  }
  std::multiset<Triangle> given;
  for (const Triangle& triangle : triangles) given.insert(turned(triangle));
  EXPECT_EQ(found, given);
}

TEST(TriangleBlocks, HoldEachTriangleOnceAndTheSameWayRound) {
  for (const int side : {2, 3, 8, 9, 31, 64, 65}) expectEachOnce(grid(side, side), side * side);
  expectEachOnce(grid(3, 100), 300);
  expectEachOnce(grid(200, 2), 400);
  for (const int count : {0, 1, 7, 64, 65, 1000}) expectEachOnce(scattered(50, count), 50);
  std::vector<Triangle> holes = grid(40, 40);
  for (std::size_t i = 0; i < holes.size(); i += 3) holes.erase(holes.begin() + static_cast<std::ptrdiff_t>(i));
  expectEachOnce(holes, 1600);
}

// At 64 nodes a row one lane in 64 is empty, where a row ends; blocks that end early waste up to seven more.
TEST(TriangleBlocks, OfAGridAreRuns) {
  TriangleBlocks blocks;
  blocks.reset(grid(64, 64));
  std::size_t lanes = 0;
  for (const TriangleBlocks::Block& block : blocks.blocks()) {
    EXPECT_TRUE(block.isRun);
    lanes += block.lanes;
  }
  EXPECT_LE(lanes, grid(64, 64).size() * 65 / 63 + 64);
}

}  // namespace
}  // namespace wetcloth_test::triangle_blocks_test
