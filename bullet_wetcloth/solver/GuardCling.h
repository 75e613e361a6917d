// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/GuardNodes.h"
#include "bullet_wetcloth/solver/GuardPlanes.h"
#include "bullet_wetcloth/solver/LayerWetness.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Holds wet layers of cloth together, up to what the water between them bears.
///
/// A vertex that touched a face at the end of the small step before is kept where it is over it: along the normal by no
/// more than its pull, along the face by no more than its shear. What acts on it harder parts them, or slides them.
class GuardCling {
 public:
  /// How near layers are.
  struct Range {
    btScalar thickness;  ///< at which they lie on each other [m]
    btScalar touching;   ///< up to which they hold each other [m]
  };

  /// For a step, of so many nodes that hold nothing yet.
  void begin(std::size_t nodes);
  /// What the nodes of a cloth from this one on bear in small steps of h [s].
  void add(std::size_t firstNode, std::size_t count, const LayerWetness& wetness, btScalar h);
  bool isEmpty() const { return m_limits.empty(); }
  /// Before each small step.
  void renew();
  /// Moves the nodes' places at the end of a small step. Returns how far two parts were brought back at most [m].
  btScalar hold(const GuardPlanes& vertexFace, const Range& range, GuardNodes& nodes);

 private:
  // Of a node: what it bears in a small step on each of its sides [kg m].
  struct Limit {
    btScalar pull = 0;
    btScalar shear = 0;
  };
  // What is left of it in this one. Of its sides the first is that of the face that was met first.
  struct Left {
    Limit of[2];
    btVector3 side = btVector3(0, 0, 0);
  };

  Limit& leftOn(std::size_t node, const btVector3& normal);
  btScalar hold(const GuardPlanes& planes, std::size_t plane, const Range& range, GuardNodes& nodes);

  std::size_t m_nodes = 0;
  std::vector<Limit> m_limits;  // of all nodes, or of none
  std::vector<Left> m_left;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
