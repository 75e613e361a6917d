// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/TriangleBlocks.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

using Triangle = TriangleBlocks::Triangle;

// The same way round, from its smallest node on.
Triangle fromSmallest(Triangle triangle) {
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

// Triangles of one shape follow each other, by where they lie.
auto order(const Triangle& t) { return std::make_tuple(t[1] - t[0], t[2] - t[0], t[0]); }

bool haveOneShape(const Triangle& a, const Triangle& b) {
  return a[1] - a[0] == b[1] - b[0] && a[2] - a[0] == b[2] - b[0];
}

std::size_t roundedUp(std::size_t lanes) {
  return (lanes + TriangleBlocks::kLanes - 1) / TriangleBlocks::kLanes * TriangleBlocks::kLanes;
}

std::size_t distance(const Triangle& from, const Triangle& to) { return static_cast<std::size_t>(to[0] - from[0]); }

// Where the run that begins at `first` ends. It may jump over a few triangles that are not there, as at the end of a
// row of a grid.
std::size_t endOfRun(const std::vector<Triangle>& triangles, std::size_t first) {
  constexpr std::size_t kLongestJump = 4;
  std::size_t end = first + 1;
  while (end < triangles.size() && haveOneShape(triangles[first], triangles[end]) &&
         distance(triangles[end - 1], triangles[end]) <= kLongestJump &&
         distance(triangles[first], triangles[end]) < TriangleBlocks::kSize) {
    ++end;
  }
  return end;
}

}  // namespace

void TriangleBlocks::reset(std::vector<Triangle> triangles) {
  m_blocks.clear();
  m_isTaken.clear();
  m_listed.clear();
  for (Triangle& triangle : triangles) triangle = fromSmallest(triangle);
  std::sort(triangles.begin(), triangles.end(), [](const auto& a, const auto& b) { return order(a) < order(b); });
  std::vector<Triangle> others;
  for (std::size_t first = 0; first < triangles.size();) {
    const std::size_t end = endOfRun(triangles, first);
    const std::size_t lanes = roundedUp(distance(triangles[first], triangles[end - 1]) + 1);
    if (2 * (end - first) >= lanes) {
      addRun(triangles, first, end);
    } else {
      others.insert(others.end(), triangles.begin() + static_cast<std::ptrdiff_t>(first),
                    triangles.begin() + static_cast<std::ptrdiff_t>(end));
    }
    first = end;
  }
  m_firstListed = m_isTaken.size();
  std::sort(others.begin(), others.end());
  addGathered(others);
}

void TriangleBlocks::open(std::size_t lanes, const Triangle& first, bool isRun) {
  m_blocks.push_back({lanes, m_isTaken.size(), first, isRun});
  m_isTaken.resize(m_isTaken.size() + lanes, 0);
}

void TriangleBlocks::addRun(const std::vector<Triangle>& triangles, std::size_t first, std::size_t end) {
  open(roundedUp(distance(triangles[first], triangles[end - 1]) + 1), triangles[first], true);
  for (std::size_t i = first; i < end; ++i) {
    m_isTaken[m_blocks.back().firstLane + distance(triangles[first], triangles[i])] = 1;
  }
}

void TriangleBlocks::addGathered(const std::vector<Triangle>& triangles) {
  for (std::size_t first = 0; first < triangles.size(); first += kSize) {
    const std::size_t count = std::min(kSize, triangles.size() - first);
    open(roundedUp(count), triangles[first], false);
    std::fill_n(m_isTaken.begin() + static_cast<std::ptrdiff_t>(m_blocks.back().firstLane), count, btScalar(1));
    const auto begin = triangles.begin() + static_cast<std::ptrdiff_t>(first);
    m_listed.insert(m_listed.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
    m_listed.resize(m_listed.size() + m_blocks.back().lanes - count, triangles[first]);
  }
}

TriangleBlocks::Triangle TriangleBlocks::corners(const Block& block, std::size_t lane) const {
  if (!block.isRun) return m_listed[block.firstLane - m_firstListed + lane];
  const int step = static_cast<int>(lane);
  return {block.first[0] + step, block.first[1] + step, block.first[2] + step};
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
