// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>
#include <LinearMath/btVector3.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;
class Water;

/// Tells an effect that moves water when it may idle, and when it must go on: a member of the effect.
///
/// It settles once it has moved no more than 1e-9 of the cloth's capacity a second (and in a step, where that is
/// longer) for 64 steps on end: by the second, since a short step moves little though much is left to move. It goes on
/// when more than 1e-7 of the capacity has been moved since, by anyone or by hand; when the capacity has changed; when
/// the cloth's shape or gravity has changed, if it depends on them; and after restart().
class WETCLOTH_EXPORT SteadyState {
 public:
  /// What the effect's work depends on.
  enum class DependsOn { water, waterAndShape };
  /// Not reached at first.
  explicit SteadyState(DependsOn inputs = DependsOn::water) : m_inputs(inputs) {}

  /// A parameter or the body changed.
  void restart();

  /// Whether the effect may leave this step out. Looks at a 32nd of the nodes at most.
  bool isReached(const btSoftBody& body, const Water& water, const btVector3& gravity);

  /// After a step of `dt` [s] that was not left out, with what it moved [kg]. May allocate in the first call after
  /// restart().
  void note(const btSoftBody& body, const Water& water, const btVector3& gravity, double dt, double moved);

  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive);

 private:
  bool shapeChanged(const btSoftBody& body, const btVector3& gravity);
  void rememberShape(const btSoftBody& body, const btVector3& gravity);

  DependsOn m_inputs;
  int m_quietSteps = 0;
  bool m_isReached = false;
  double m_capacity = 0;           // when it settled
  double m_movedBefore = 0;        // Water::moved() when it settled
  std::vector<btVector3> m_shape;  // when it settled
  btVector3 m_gravity = btVector3(0, 0, 0);
  btScalar m_tolerance2 = 0;   // of a node's place, squared [m^2]
  std::size_t m_nextNode = 0;  // to look at
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
