// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "bullet_wetcloth/numerics/TiltedGlass.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"

#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace wetcloth_test::drops_scene {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Numbers of the ledger are sums of this much water at most, [kg], and rounded in each step.
inline constexpr double kLedger = 1e-12;

inline wetcloth::DropAir vacuum() {
  wetcloth::DropAir air;
  air.density = 0;
  air.viscosity = 0;
  return air;
}

/// A level square about the origin, all of whose nodes are pinned.
inline wetcloth::ClothPatch pinned(int n, double side = 1) {
  wetcloth::ClothPatch patch = levelPatch(n, side);
  for (int i = 0; i < n * n; ++i) patch.pinnedNodes.push_back(i);
  return patch;
}

/// A level, pinned cloth of one metre, dry, and the drops of its world; only our part of each step, so that it stays.
class DropsScene {
 public:
  explicit DropsScene(wetcloth::Drops::Parameters parameters = {}, const wetcloth::ClothPatch& patch = pinned(9),
                      const btVector3& gravity = kEarthGravity)
      : m_scene(WorldKind::softRigid, gravity, patch, wetcloth::Fabric::cotton(), wetcloth::Hook::manual),
        drops(m_scene.wet(), std::move(parameters)) {}

  void step(int count, double dt = kSubstep) {
    for (int i = 0; i < count; ++i) m_scene.preTick(dt);
  }
  wetcloth::WetCloth& cloth() { return m_scene.cloth(); }
  ClothScene& scene() { return m_scene; }

 private:
  ClothScene m_scene;

 public:
  wetcloth::Drops drops;  // of the scene's world, which outlives it
};

/// One drop of this diameter, which leaves at the beginning of the second substep.
inline wetcloth::Pour oneDrop(const btVector3& position, const btVector3& velocity, double diameter = 4e-3) {
  wetcloth::Pour pour;
  pour.position = position;
  pour.velocity = velocity;
  pour.dropDiameter = diameter;
  // All of the drop in a billionth of a second, so that none of the second is flown before.
  pour.flow = 1.000001 * wetcloth::dropMass(diameter, wetcloth::DropAir().waterDensity) / 1e-9;
  pour.stop = 1e-9;
  return pour;
}

}  // namespace wetcloth_test::drops_scene
