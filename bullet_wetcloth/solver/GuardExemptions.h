// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/GuardNodes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Which nodes of cloths are not kept from which rigid bodies, with all parts that they belong to: they stand in them,
/// are fixed to them, or Bullet has been told that they do not collide.
class GuardExemptions {
 public:
  /// Forgets all exemptions.
  void clear() { m_exempt.clear(); }
  /// Forgets whose the nodes of bodies are. @param firstOfBodies  the first of them among all nodes
  void clearNodes(int firstOfBodies) {
    m_firstOfBodies = firstOfBodies;
    m_bodyOfNode.clear();
  }
  /// The next nodes of bodies are this one's, a number from 0.
  void addNodes(int body, std::size_t count) { m_bodyOfNode.insert(m_bodyOfNode.end(), count, body); }
  void add(int node, int body) { m_exempt.emplace_back(body, node); }
  /// After all add().
  void sort() {
    std::sort(m_exempt.begin(), m_exempt.end());
    m_exempt.erase(std::unique(m_exempt.begin(), m_exempt.end()), m_exempt.end());
  }
  bool isEmpty() const { return m_exempt.empty(); }
  /// How many there are, of a node and a body each.
  std::size_t size() const { return m_exempt.size(); }
  /// Takes out the pairs that are exempt.
  void takeFrom(GuardCandidates& pairs) const {
    if (isEmpty()) return;
    const auto isExempt = [this](const GuardPair& pair) { return has(pair); };
    for (std::vector<GuardPair>* const kind : {&pairs.vertexFace, &pairs.edgeEdge}) {
      kind->erase(std::remove_if(kind->begin(), kind->end(), isExempt), kind->end());
    }
  }

 private:
  bool has(const GuardPair& pair) const {
    int body = -1;
    for (const int node : pair.node) {
      if (node >= m_firstOfBodies) body = m_bodyOfNode[static_cast<std::size_t>(node - m_firstOfBodies)];
    }
    if (body < 0) return false;
    return std::any_of(std::begin(pair.node), std::end(pair.node), [&](int node) {
      return node < m_firstOfBodies && std::binary_search(m_exempt.begin(), m_exempt.end(), std::make_pair(body, node));
    });
  }

  int m_firstOfBodies = 0;
  std::vector<int> m_bodyOfNode;
  std::vector<std::pair<int, int>> m_exempt;  // body and node
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
