// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/GuardMesh.h"

#include <LinearMath/btVector3.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// Nodes of a mesh that stood at one place when it was made: the sides of a cut, and seams along which meshes have
/// nodes twice. They count as one node until they have come apart, once: until each is on the side of its own
/// neighbours. Sides that only slide over each other have not come apart; held so they would hook into each other.
class CoincidentNodes {
 public:
  /// The body has another mesh, whose first nodes are those that were known if there are no fewer: Bullet's cuts add
  /// theirs at the end.
  void keepOf(std::size_t nodeCount);
  /// Those at places that are equal, and those that count as one already.
  void find(const std::vector<btVector3>& places);
  /// They have come apart when they are a tenth of the shortest edge from each other that either has, where all edges
  /// are as long as between these places.
  void setEdges(const std::vector<GuardMesh::Edge>& edges, const std::vector<btVector3>& places);
  /// Whether all have come apart, for good.
  bool isEmpty() const { return m_joined.empty() && m_left.empty(); }
  /// One node of those that this one counts as, itself if there is no other.
  int first(int node) const { return m_first.empty() ? node : m_first[static_cast<std::size_t>(node)]; }
  /// Those that have come apart from the first of theirs leave it. They may still be one among themselves. Returns
  /// whether some have left.
  /// @param placeOf  of a node [m]
  template <class PlaceOf>
  bool separate(const PlaceOf& placeOf) {
    m_left.clear();
    for (const int node : m_joined) {
      const int other = first(node);
      const btVector3 away = middleAround(node, placeOf) - middleAround(other, placeOf);
      const btScalar apart = std::min(apartOf(node), apartOf(other));
      if ((placeOf(node) - placeOf(other)).dot(away) > apart * away.length()) m_left.push_back({other, node});
    }
    endSeparating();
    return !m_left.empty();
  }
  /// Counts two of them as one again, with all that left with them, if they left each other when separate() was called
  /// last: where sides cross they have not come apart. Returns whether they did.
  bool joinAgain(int a, int b);

  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive, int nodeCount);

 private:
  struct Leaving {
    int other;  // the first that it had
    int node;
  };
  void fitTo(std::size_t nodeCount);
  void findJoined();
  void endSeparating();
  btScalar apartOf(int node) const { return m_apart[static_cast<std::size_t>(node)]; }
  // Of its neighbours.
  template <class PlaceOf>
  btVector3 middleAround(int node, const PlaceOf& placeOf) const {
    const std::vector<int>& around = m_around[static_cast<std::size_t>(node)];
    btVector3 sum(0, 0, 0);
    for (const int neighbour : around) sum += placeOf(neighbour);
    return around.empty() ? placeOf(node) : sum / static_cast<btScalar>(around.size());
  }

  std::vector<int> m_first;                // of each node; empty: all are their own
  std::vector<btScalar> m_apart;           // of each node: how far from another it is apart [m]
  std::vector<std::vector<int>> m_around;  // of each of them: its neighbours
  std::vector<int> m_joined;               // nodes that are not their own, ascending
  std::vector<Leaving> m_left;             // when separate() was called last
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
