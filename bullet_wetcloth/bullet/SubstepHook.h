// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletDynamics/Dynamics/btDynamicsWorld.h>

#include <functional>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Shares Bullet's callbacks of a substep with the application: the pre-tick callback, before Bullet predicts, and the
/// tick callback, between its collision detection and the solve of the soft bodies.
///
/// Bullet has a single slot for each, no getter, and setting one overwrites the world's user info, which an
/// application (Bullet's own SoftDemo, for its picking) may read in its callback. So the slots are read and written
/// directly, the user info is never touched, and a world's hook is found from the world's address.
class SubstepHook {
 public:
  enum class Slot { preTick, tick };
  /// What we do in a slot, with the length of the substep [s].
  using Callback = std::function<void(btScalar dt)>;

  /// The one hook of this world, which has no slot yet. Throws std::invalid_argument when the world has another one.
  SubstepHook(btDynamicsWorld& world, Callback onPreTick, Callback onTick);
  /// Does not touch the world, which may be gone: a slot that was not given back goes on to the application's callback,
  /// and is given back when Bullet calls it.
  ~SubstepHook();
  SubstepHook(const SubstepHook&) = delete;
  SubstepHook& operator=(const SubstepHook&) = delete;

  /// Takes a slot, when it is not ours already: from then on the application's callback runs first and ours after it.
  void take(Slot slot);
  /// Puts the application's callback back, unless somebody took the slot after us. If that one calls us, the call goes
  /// on to the application's callback.
  void giveBack(Slot slot);
  /// Whether Bullet will call us first in the next substep.
  bool isInPlace(Slot slot) const;

  void call(Slot slot, btScalar dt) const { (slot == Slot::preTick ? m_onPreTick : m_onTick)(dt); }

 private:
  btDynamicsWorld& m_world;
  Callback m_onPreTick;
  Callback m_onTick;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
