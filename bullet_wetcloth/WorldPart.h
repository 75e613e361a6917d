// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btScalar.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class BodyFilms;
class StateArchive;
class WetCloth;
class WetClothWorld;

/// What stands beside the cloths of a WetClothWorld and has its turn in each substep, after the effects of all cloths
/// and before what came to these by it is committed: Drops.
///
/// It is in the world from its construction to its end, or to the world's, whichever comes first.
class WETCLOTH_EXPORT WorldPart {
 public:
  WorldPart(const WorldPart&) = delete;
  WorldPart& operator=(const WorldPart&) = delete;
  /// Leaves the world.
  virtual ~WorldPart();

  /// The world, or null once that is gone.
  WetClothWorld* world() const { return m_world; }

 protected:
  /// Enters the world. Throws std::invalid_argument when that is detached, or has a part already.
  explicit WorldPart(WetClothWorld& world);

 private:
  friend class WetClothWorld;
  /// The part of one substep of `dt` seconds that begins at `time` [s]. Never throws.
  virtual void step(double dt, double time) = 0;
  /// A cloth was added to the world, or is one of it when the part enters.
  virtual void follow(WetCloth& cloth) = 0;
  /// A cloth is about to be removed.
  virtual void forget(const WetCloth& cloth) = 0;
  /// Films on rigid bodies, from which ContactWetting takes.
  virtual BodyFilms* films() = 0;
  /// Names what it carries from one step to the next: see StateArchive.
  virtual void transferState(StateArchive& archive) = 0;

  WetClothWorld* m_world;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
