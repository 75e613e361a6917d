#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletDynamics/Dynamics/btDynamicsWorld.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class WetClothWorld;

/// Shares Bullet's one pre-tick callback with the application.
///
/// Bullet has a single slot, no getter for it, and setting it overwrites the world's user info, which an application
/// (Bullet's own SoftDemo, for its picking) may read in its callback. So the slot is read and written directly, the
/// user info is never touched, and our object is found from the world's address.
class PreTickHook {
 public:
  /// Registers the one WetClothWorld of its world, and takes the slot when `takeSlot`: from then on the application's
  /// callback runs first and ours after it. Throws std::invalid_argument when the world has one already.
  static void attach(WetClothWorld& wetWorld, bool takeSlot);
  /// Puts the application's callback back. If somebody took the slot after us and calls us from there, we go on
  /// passing the call to the application's callback.
  static void detach(WetClothWorld& wetWorld);
  /// Whether Bullet will call us first in the next substep.
  static bool isInPlace(btDynamicsWorld& world);
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
