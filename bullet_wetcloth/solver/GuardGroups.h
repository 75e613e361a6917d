// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/GuardNodes.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Nodes that have to be slowed together, because something would meet otherwise.
///
/// All of a group's motion in a small step against its mean is slowed by one share: at 0 it goes as one, and then no
/// gap in it changes. A gap is a concave function of the share, so that a share at which the straight line between both
/// ends reaches what is wanted leaves at least that. Momentum stays, unless a node is imposed: then the group goes with
/// it.
class GuardGroups {
 public:
  /// Forgets all groups of so many nodes.
  void clear(std::size_t nodes);
  /// Four nodes are of one group.
  void join(const int (&nodes)[4]);
  /// After all join(): the means.
  void measure(const GuardNodes& nodes);
  /// Of the motion against the mean in this node's group no more than this share is left, [0, 1].
  void limit(int node, double share);
  /// Moves the nodes.
  void apply(GuardNodes& nodes);
  /// How many nodes are in groups.
  std::size_t size() const { return m_members.size(); }

 private:
  struct Group {
    double sum[3] = {0, 0, 0};
    double mass = 0;
    double share = 1;
    bool isImposed = false;
  };
  int find(int node);

  std::vector<int> m_parent;  // of each node; -1: in no group
  std::vector<int> m_members;
  std::vector<Group> m_groups;  // at its root's number
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
