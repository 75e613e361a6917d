// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btVector3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// How several others that touch a node on the same side share what goes through its area there: together they have
/// what the one that would have most would have alone. So k at one place have what one has, one alone has all of it,
/// and the two sides of a node know nothing of each other.
class WETCLOTH_EXPORT SideShares {
 public:
  /// Of a cloth, at a node.
  enum class Side { front, back };
  /// The one on which something lies in the direction `towards`, seen from the node. Front is where the normal points.
  static Side sideOf(const btVector3& normal, const btVector3& towards) {
    return normal.dot(towards) < 0 ? Side::back : Side::front;
  }

  /// Nothing touches yet. Allocates for more nodes than ever before.
  void reset(std::size_t nodes) { m_nodes.assign(nodes, {}); }
  /// One of the others would have so much through a node's side, >= 0. All that `who` adds comes before another one's.
  void add(std::size_t node, Side side, int who, double wanted) {
    Sum& sum = at(node, side);
    if (sum.who != who) sum.ofWho = 0;
    sum.who = who;
    sum.ofWho += wanted;
    sum.most = std::max(sum.most, sum.ofWho);
    sum.all += wanted;
  }
  /// What is left for each of them of what it would have alone, (0, 1].
  double share(std::size_t node, Side side) const {
    const Sum& sum = m_nodes[node][static_cast<std::size_t>(side)];
    return sum.all > 0 ? sum.most / sum.all : 1;
  }

 private:
  struct Sum {
    double all = 0;
    double most = 0;   // of one of them
    double ofWho = 0;  // so far
    int who = -1;
  };
  Sum& at(std::size_t node, Side side) { return m_nodes[node][static_cast<std::size_t>(side)]; }

  std::vector<std::array<Sum, 2>> m_nodes;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
