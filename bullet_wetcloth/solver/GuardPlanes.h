// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/bullet/PackedNodes.h"
#include "bullet_wetcloth/solver/GuardNodes.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Planes between pairs of one kind, in arrays of which a processor reads four at once.
///
/// Between two parts the gap along a plane's normal is what is left between their nearest nodes: positive, each part is
/// on its side. The places are the two that were nearest when the plane was made: means of the nodes by weights.
class GuardPlanes {
 public:
  /// How many planes are measured at once.
  static constexpr std::size_t kAtOnce = 4;

  /// A plane as it is made.
  struct Plane {
    GuardPair pair;
    btScalar normal[3];
    btScalar weights[4];  ///< of the first part's nodes, and minus those of the second's; their sum is 0
    btScalar gap;         ///< [m]
    btScalar apart;       ///< the two places, along the normal [m]
  };

  /// @param first  how many nodes are of the first part, in all pairs
  explicit GuardPlanes(int first) : m_first(first) {}

  void clear();
  void add(const Plane& plane);
  std::size_t size() const { return m_gap.size(); }
  int first() const { return m_first; }

  int node(std::size_t plane, int which) const { return m_node[which][plane]; }
  /// The tile in which a part was found.
  int tile(std::size_t plane, int part) const { return m_tile[part][plane]; }
  btScalar weight(std::size_t plane, int which) const { return m_weight[which][plane]; }
  btVector3 normal(std::size_t plane) const {
    return btVector3(m_normal[0][plane], m_normal[1][plane], m_normal[2][plane]);
  }
  /// At the end of the small step before [m].
  btScalar gap(std::size_t plane) const { return m_gap[plane]; }
  btScalar apart(std::size_t plane) const { return m_apart[plane]; }

  /// Of kAtOnce planes from this one on.
  struct Measure {
    btScalar gap[kAtOnce];
    btScalar apart[kAtOnce];
  };
  /// Where the nodes are at these places.
  Measure measure(std::size_t begin, const std::vector<GuardNodes::Place>& at) const;
  /// The same of one plane, and which of the first and of the second part's nodes are nearest.
  struct Nearest {
    btScalar gap;
    btScalar apart;
    int low;
    int high;
  };
  Nearest nearest(std::size_t plane, const std::vector<GuardNodes::Place>& at) const;
  /// These are now those of the small step before.
  void keep(std::size_t begin, const Measure& measure);

  /// Takes out planes. @param isKept  called with each one's number
  template <class IsKept>
  std::size_t filter(const IsKept& isKept) {
    std::vector<std::size_t> kept;
    for (std::size_t plane = 0; plane < size(); ++plane) {
      if (isKept(plane)) kept.push_back(plane);
    }
    const std::size_t gone = size() - kept.size();
    if (gone > 0) pick(kept);
    return gone;
  }

 private:
  void pick(const std::vector<std::size_t>& kept);

  int m_first;
  std::vector<int> m_node[4];
  std::vector<int> m_tile[2];
  std::vector<btScalar> m_normal[3];
  std::vector<btScalar> m_weight[4];
  std::vector<btScalar> m_gap;
  std::vector<btScalar> m_apart;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
