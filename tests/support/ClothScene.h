// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/Measures.h"

#include <memory>

namespace wetcloth_test {

/// Substep of the paper's fall test [s].
inline constexpr double kSubstep = 1.0 / 240;
/// A substep that float32 and float64 hold without rounding [s]. Bullet takes the step as float in some places, so
/// only with such a step can its motion be compared more closely than 1e-7.
inline constexpr double kExactSubstep = 1.0 / 256;

/// A BodyScene whose body is a wet cloth, whose water moves in every substep, so that each can be held against the
/// laws, and which never sleeps: the deformable world puts slow bodies to sleep, which would stop what is measured.
class ClothScene : public BodyScene {
 public:
  ClothScene(WorldKind kind, const btVector3& gravity, const BodyBuilder& builder,
             const wetcloth::Fabric& fabric = wetcloth::Fabric::cotton(), wetcloth::Hook hook = wetcloth::Hook::preTick)
      : BodyScene(kind, builder, gravity), m_wet(world(), hook), m_cloth(m_wet.add(body(), fabric)) {
    body().setActivationState(DISABLE_DEACTIVATION);
    m_cloth.setPace(wetcloth::WaterPace::exact());
  }
  ClothScene(WorldKind kind, const btVector3& gravity, const wetcloth::ClothPatch& patch,
             const wetcloth::Fabric& fabric = wetcloth::Fabric::cotton(), wetcloth::Hook hook = wetcloth::Hook::preTick)
      : ClothScene(
            kind, gravity, [&patch](btSoftBodyWorldInfo& info) { return patch.build(info); }, fabric, hook) {}

  wetcloth::WetClothWorld& wet() { return m_wet; }
  wetcloth::WetCloth& cloth() { return m_cloth; }

  /// Bullet's own springs, as stiff as explicit integration with this substep bears well.
  void addBulletSpringsForStep(double dt = kSubstep) {
    const double massPerNode = freeMass(body()) / body().m_nodes.size();
    addBulletSprings(0.1 * massPerNode / (dt * dt));
  }

  void step(int count, double dt = kSubstep) { bullet().step(count, btScalar(dt)); }
  /// Only our part of a substep, Bullet's left out; for Hook::manual.
  void preTick(double dt) { m_wet.preTick(btScalar(dt)); }

 private:
  wetcloth::WetClothWorld m_wet;
  wetcloth::WetCloth& m_cloth;
};

}  // namespace wetcloth_test
