// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/Crossings.h"
#include "bullet_wetcloth/solver/GuardNodes.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What is not kept apart while it crosses: all parts that have a node of a crossing edge, from all parts that have one
/// of the face that it crosses. So there is a ring of parts around a crossing in which it may move.
class CrossingExemptions {
 public:
  /// Of these crossings, and no others.
  /// @param nodeCount  of all cloths, those of rigid bodies left out
  void set(const std::vector<Crossing>& crossings, std::size_t nodeCount) {
    m_pairs.clear();
    m_isIn.assign(crossings.empty() ? 0 : nodeCount, false);
    for (const Crossing& crossing : crossings) {
      for (const int a : crossing.edge) {
        m_isIn[static_cast<std::size_t>(a)] = true;
        for (const int b : crossing.face) m_pairs.emplace_back(std::min(a, b), std::max(a, b));
      }
      for (const int b : crossing.face) m_isIn[static_cast<std::size_t>(b)] = true;
    }
    std::sort(m_pairs.begin(), m_pairs.end());
    m_pairs.erase(std::unique(m_pairs.begin(), m_pairs.end()), m_pairs.end());
  }
  /// Takes out the pairs that are exempt.
  void takeFrom(GuardCandidates& pairs) const {
    if (m_pairs.empty()) return;
    pairs.removeIfAny([this](int a, int b) { return has(a, b); });
  }

 private:
  bool isIn(int node) const {
    return static_cast<std::size_t>(node) < m_isIn.size() && m_isIn[static_cast<std::size_t>(node)];
  }
  bool has(int a, int b) const {
    if (!isIn(a) || !isIn(b)) return false;
    return std::binary_search(m_pairs.begin(), m_pairs.end(), std::pair<int, int>(std::minmax(a, b)));
  }

  std::vector<std::pair<int, int>> m_pairs;  // of nodes, the smaller number first
  std::vector<bool> m_isIn;                  // some pair, of each node
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
