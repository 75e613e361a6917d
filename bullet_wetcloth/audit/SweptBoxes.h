// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A box along the axes; empty at first. Boxes that only touch overlap, an empty one overlaps nothing. Its numbers are
/// float in either precision, half the memory to go through; whoever has double rounds them outwards.
struct SweptBox {
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  float low[3] = {kInfinity, kInfinity, kInfinity};
  float high[3] = {-kInfinity, -kInfinity, -kInfinity};

  void include(const SweptBox& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], other.low[k]);
      high[k] = std::max(high[k], other.high[k]);
    }
  }
  bool isEmpty() const { return high[0] < low[0]; }
  bool overlaps(const SweptBox& other) const {
    bool result = true;
    for (std::size_t k = 0; k < 3; ++k) result &= low[k] <= other.high[k] && other.low[k] <= high[k];
    return result;
  }
};

/// Boxes to compare one with many: each of their six numbers has an array of its own, so that the compiler takes
/// kWide of them at a time.
class SweptBoxes {
 public:
  static constexpr std::size_t kWide = 4;
  static constexpr std::size_t kMost = 48;  ///< compared at a time
  static std::size_t wholeBlocks(std::size_t count) { return (count + kWide - 1) / kWide * kWide; }

  std::size_t size() const { return m_low[0].size(); }
  void resize(std::size_t size) {
    for (std::vector<float>& side : m_low) side.resize(size, SweptBox::kInfinity);
    for (std::vector<float>& side : m_high) side.resize(size, -SweptBox::kInfinity);
  }
  void set(std::size_t index, const SweptBox& box) {
    for (std::size_t k = 0; k < 3; ++k) {
      m_low[k][index] = box.low[k];
      m_high[k][index] = box.high[k];
    }
  }
  SweptBox operator[](std::size_t i) const {
    return {{m_low[0][i], m_low[1][i], m_low[2][i]}, {m_high[0][i], m_high[1][i], m_high[2][i]}};
  }

  /// Writes which of [begin, end) overlap the box, and returns how many. Both are multiples of kWide, at most kMost
  /// apart; `found` needs room for all.
  std::size_t findOverlapping(const SweptBox& box, std::size_t begin, std::size_t end, int* found) const {
    if (begin == end) return 0;
    int overlaps[kMost];
    const std::size_t size = (end - begin) / kWide * kWide;  // as it is: for the compiler to know
    const float* const low[3] = {&m_low[0][begin], &m_low[1][begin], &m_low[2][begin]};
    const float* const high[3] = {&m_high[0][begin], &m_high[1][begin], &m_high[2][begin]};
    const SweptBox b = box;
    for (std::size_t i = 0; i < size; ++i) {
      overlaps[i] = (low[0][i] <= b.high[0] ? 1 : 0) & (high[0][i] >= b.low[0] ? 1 : 0) &
                    (low[1][i] <= b.high[1] ? 1 : 0) & (high[1][i] >= b.low[1] ? 1 : 0) &
                    (low[2][i] <= b.high[2] ? 1 : 0) & (high[2][i] >= b.low[2] ? 1 : 0);
    }
    std::size_t count = 0;
    for (std::size_t i = 0; i < size; ++i) {  // without a branch, which no processor could foresee
      found[count] = static_cast<int>(begin + i);
      count += static_cast<std::size_t>(overlaps[i]);
    }
    return count;
  }

 private:
  std::vector<float> m_low[3];
  std::vector<float> m_high[3];
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
