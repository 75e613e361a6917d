// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletDynamics/Dynamics/btDynamicsWorld.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class WetClothWorld;

/// Shares Bullet's callbacks of a substep with the application: the pre-tick callback, before Bullet predicts, and the
/// tick callback, between its collision detection and the solve of the soft bodies.
///
/// Bullet has a single slot for each, no getter, and setting one overwrites the world's user info, which an
/// application (Bullet's own SoftDemo, for its picking) may read in its callback. So the slots are read and written
/// directly, the user info is never touched, and our object is found from the world's address.
class SubstepHook {
 public:
  enum class Slot { preTick, tick };

  /// Registers the one WetClothWorld of its world. Throws std::invalid_argument when the world has one already.
  static void attach(WetClothWorld& wetWorld);
  /// Gives both slots back and forgets the WetClothWorld. If somebody took a slot after us and calls us from there, we
  /// go on passing the call to the application's callback.
  static void detach(WetClothWorld& wetWorld);

  /// Takes a slot, when it is not ours already: from then on the application's callback runs first and ours after it.
  static void take(WetClothWorld& wetWorld, Slot slot);
  /// Puts the application's callback back, unless somebody took the slot after us.
  static void giveBack(WetClothWorld& wetWorld, Slot slot);
  /// Whether Bullet will call us first in the next substep.
  static bool isInPlace(btDynamicsWorld& world, Slot slot);
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
