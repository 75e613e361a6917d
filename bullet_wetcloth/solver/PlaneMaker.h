// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/GuardNodes.h"
#include "bullet_wetcloth/solver/GuardPlanes.h"

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Puts planes between the parts of pairs that may come near each other.
class PlaneMaker {
 public:
  struct Outlook {
    btScalar near;      ///< what a plane holds farther apart wherever nodes are expected is left out [m]
    btScalar rounding;  ///< of a place [m]
  };

  PlaneMaker(const GuardNodes& nodes, const Outlook& outlook) : m_nodes(nodes), m_outlook(outlook) {}

  /// Adds planes between the parts of these pairs, where they are `from`. Returns how many meet, and get no plane.
  /// @tparam first  planes.first()
  template <int first>
  long long make(const std::vector<GuardPair>& pairs, GuardPlanes& planes) const;

 private:
  template <int first>
  unsigned makeFour(const GuardPair* pairs, unsigned wanted, GuardPlanes& planes) const;
  template <int first>
  bool makeExactly(const GuardPair& pair, GuardPlanes& planes) const;

  const GuardNodes& m_nodes;
  Outlook m_outlook;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
