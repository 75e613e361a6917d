// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/CoincidentNodes.h"
#include "bullet_wetcloth/solver/GuardNodes.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What is not kept apart since it has nodes that count as one: as parts do not that share a node.
class CoincidentExemptions {
 public:
  void clear() {
    m_first.clear();
    m_count = 0;
  }
  /// The next nodes of all are these, of which those count as one; null: none do.
  void add(std::size_t count, const CoincidentNodes* nodes) {
    if (nodes && !nodes->isEmpty()) {
      while (m_first.size() < m_count) m_first.push_back(static_cast<int>(m_first.size()));
      for (int node = 0; node < static_cast<int>(count); ++node) {
        m_first.push_back(static_cast<int>(m_count) + nodes->first(node));
      }
    }
    m_count += count;
  }
  bool isEmpty() const { return m_first.empty(); }
  bool areOne(int a, int b) const { return first(a) == first(b); }
  /// Takes out the pairs that are exempt.
  void takeFrom(GuardCandidates& pairs) const {
    if (isEmpty()) return;
    pairs.removeIfAny([this](int a, int b) { return areOne(a, b); });
  }

 private:
  int first(int node) const {
    return static_cast<std::size_t>(node) < m_first.size() ? m_first[static_cast<std::size_t>(node)] : node;
  }

  std::vector<int> m_first;  // of each node, but for the last that are their own
  std::size_t m_count = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
