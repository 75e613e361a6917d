// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/GuardNodes.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Which nodes the guard slowed or stopped, for how long, and where most of them were.
class GuardStops {
 public:
  /// Before the first small step of a step, of so many nodes of cloths.
  /// @param areSame  they are those of the step before: what was stopped at its end may go on being so
  void begin(std::size_t nodes, bool areSame);
  /// These nodes, in this small step; each may come more than once, and those of bodies do not count.
  void add(const std::vector<int>& nodes);
  /// All nodes that are not imposed.
  void addAll(const GuardNodes& nodes);
  /// After a small step of h [s].
  /// @param origin  of the nodes' places [m]
  void endSmallStep(btScalar h, const GuardNodes& nodes, const btVector3& origin);

  /// Whether a node was slowed in the step that began last.
  bool wasStopped(std::size_t node) const { return node < m_inStep.size() && m_inStep[node] != 0; }
  /// The longest time for which a node was slowed in each small step [s].
  double longest() const { return m_longest; }
  /// The most nodes that were slowed in one small step.
  long long most() const { return m_most; }
  /// The mean of their places [m].
  const btVector3& placeOfMost() const { return m_placeOfMost; }
  /// Forgets the longest and the most.
  void reset();

 private:
  std::vector<unsigned char> m_inStep;
  std::vector<unsigned char> m_now;
  std::vector<btScalar> m_time;  // for which each node has been slowed by now [s]
  bool m_isAnyNow = false;
  bool m_isAnyOn = false;  // a time is not 0
  double m_longest = 0;
  long long m_most = 0;
  btVector3 m_placeOfMost = btVector3(0, 0, 0);
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
