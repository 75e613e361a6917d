// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/GuardNodes.h"
#include "bullet_wetcloth/solver/GuardPlanes.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Nodes that have to be slowed together, because something would meet otherwise.
///
/// All of a group's motion in a small step against its mean is slowed by one share: at 0 it goes as one, and then no
/// gap in it changes. A gap is a concave function of the share, so that a share at which the straight line between both
/// ends reaches what is wanted leaves at least that. Momentum stays, unless a node is imposed: then the group goes with
/// it. Where a rigid body touches, it goes with that place of the body; what touches one body need not be one group.
class GuardGroups {
 public:
  /// Forgets all groups of so many nodes.
  void clear(std::size_t nodes);
  /// The nodes that this plane keeps apart are of one group.
  void join(const GuardNodes& nodes, const GuardPlanes& planes, std::size_t plane);
  /// After all join(): the means.
  void measure(const GuardNodes& nodes);
  /// Of the motion against the mean in this plane's group no more than this share is left, [0, 1].
  void limit(const GuardNodes& nodes, const GuardPlanes& planes, std::size_t plane, double share);
  /// Moves the nodes. @param eachByItself  what a body touches goes with that place, in place of the mean of all
  void apply(GuardNodes& nodes, bool eachByItself);
  /// The nodes that are in groups.
  const std::vector<int>& members() const { return m_members; }

 private:
  struct Group {
    double sum[3] = {0, 0, 0};
    double mass = 0;
    double share = 1;
    bool isImposed = false;
    btVector3 gain = btVector3(0, 0, 0);  // of momentum, times the small step [kg m]
    btScalar way = 0;                     // of its nodes, on the whole [kg m^2]
    int contacts = 0;                     // with bodies
  };
  // Where a body touches a node's part: means of the body's nodes.
  struct Contact {
    int bodyNode[3];
    btScalar weight[3];  // their sum is 1
    int count = 0;       // of these; 0: none
  };
  int find(int node);
  static double wayOf(const Contact& contact, const GuardNodes& nodes, std::size_t axis);
  void recoil(GuardNodes& nodes);

  std::vector<int> m_parent;  // of each node; -1: in no group
  std::vector<int> m_members;
  std::vector<Group> m_groups;      // at its root's number
  std::vector<Contact> m_contacts;  // of each node
  bool m_hasContacts = false;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
