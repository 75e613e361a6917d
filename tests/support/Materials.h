// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Fabric.h"
#include "bullet_wetcloth/effects/HookeSprings.h"

namespace wetcloth_test {

/// A fabric that holds `capacity` times its dry mass and fills with this time constant [s].
inline wetcloth::Fabric fabricOf(double capacity, double timeConstant) {
  wetcloth::Fabric fabric;
  fabric.capacity = capacity;
  fabric.timeConstant = timeConstant;
  return fabric;
}

/// Springs of these stiffnesses [N/m].
inline wetcloth::HookeSprings::Parameters springsOf(double stiffness, double bendingStiffness = 10) {
  wetcloth::HookeSprings::Parameters springs;
  springs.stiffness = stiffness;
  springs.bendingStiffness = bendingStiffness;
  return springs;
}

}  // namespace wetcloth_test
