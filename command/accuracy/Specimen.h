// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/BulletWorld.h"

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <optional>

namespace accuracy {

/// A patch of cloth in a world of its own: what most studies look at.
class Specimen {
 public:
  struct Settings {
    wetcloth::ClothPatch patch;
    wetcloth::Fabric fabric = wetcloth::Fabric::cotton();
    wetcloth::WaterPace pace = wetcloth::WaterPace::exact();
    command::BulletWorld::Settings world;
    std::optional<command::DeformableSprings> springs;  ///< of the deformable world
  };

  explicit Specimen(const Settings& settings);

  btSoftBody& body() { return *m_body; }
  wetcloth::WetCloth& cloth() { return *m_cloth; }
  double nodes() const { return m_body->m_nodes.size(); }

  /// A box whose top is at y = 0.
  void addFloor();
  /// One of Bullet's steps, ours within.
  void substep(double dt) { m_world.substep(btScalar(dt)); }
  /// Our part of a step alone: Bullet neither moves nor collides anything.
  void substepOfOurs(double dt) { m_world.wet().preTick(btScalar(dt)); }

 private:
  command::BulletWorld m_world;
  btSoftBody* m_body;
  wetcloth::WetCloth* m_cloth;
};

/// A square patch in the plane y = 0, its corner at the origin. @param side [m]; @param nodes along a side
wetcloth::ClothPatch levelSquare(double side, int nodes, double arealDensity = 0.150);

}  // namespace accuracy
