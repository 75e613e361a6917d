// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/solver/ClothSolver.h"

#include <LinearMath/btVector3.h>

#include <cstddef>
#include <vector>

class btSoftBody;

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// Where the nodes of a body were after each small step of the last substep that a ClothSolver took it through.
class SmallStepRecord : public ClothSolver::SmallStepObserver {
 public:
  explicit SmallStepRecord(const btSoftBody& body) : m_body(body) {}

  void afterSmallStep(const ClothSolver::SmallStepView& view) override;
  void clear() { m_places.clear(); }
  /// How many small steps of a body with that many nodes: 0 when it was not stepped, or had another number of them.
  int count(std::size_t nodes) const;
  /// x, y, z of each node [m], from origin().
  const btScalar* places(int step) const { return m_places.data() + 3 * m_nodes * static_cast<std::size_t>(step); }
  const btVector3& origin() const { return m_origin; }

  /// All of it.
  void transferState(StateArchive& archive);

 private:
  const btSoftBody& m_body;
  std::size_t m_nodes = 0;
  std::vector<btScalar> m_places;
  btVector3 m_origin{0, 0, 0};
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
