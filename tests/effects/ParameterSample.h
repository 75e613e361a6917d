// SPDX-License-Identifier: Zlib
#pragma once

#include "tests/support/ClothScene.h"

#include <vector>

namespace wetcloth_test::parameters {

using namespace wetcloth;

inline constexpr int kSteps = 12;

/// A half wet cloth that slides on a box with one edge and hangs above it with the rest. What an effect does shows in
/// its motion, its water or its links.
class Sample {
 public:
  explicit Sample(WorldKind kind = WorldKind::softRigid)
      : m_box(btVector3(2, btScalar(0.5), 2)),
        m_floor(0, nullptr, &m_box),
        scene(kind, kEarthGravity, [](btSoftBodyWorldInfo& info) { return tiltedPatch().build(info); }) {
    m_floor.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, btScalar(-0.5), 0)));
    scene.bullet().world().addRigidBody(&m_floor);
    std::vector<double> held;
    for (int i = 0; i < scene.body().m_nodes.size(); ++i) {
      held.push_back(scene.cloth().capacity(i) * (0.2 + 0.7 * i / scene.body().m_nodes.size()));
      scene.node(i).m_v = btVector3(btScalar(0.01 * i), btScalar(-0.1), btScalar(0.2));
    }
    scene.cloth().setHeld(held);
  }
  ~Sample() { scene.bullet().world().removeRigidBody(&m_floor); }

  const btCollisionObject& floor() const { return m_floor; }
  WetCloth& cloth() { return scene.cloth(); }

  std::vector<double> state() {
    std::vector<double> values;
    for (int i = 0; i < scene.body().m_nodes.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        values.push_back(double(scene.node(i).m_x[axis]));
        values.push_back(double(scene.node(i).m_v[axis]));
      }
      values.push_back(cloth().held(i));
    }
    for (int k = 0; k < scene.body().m_links.size(); ++k) {
      values.push_back(double(scene.body().m_links[k].m_rl));
      values.push_back(double(scene.body().m_links[k].m_c0));
    }
    return values;
  }

 private:
  static ClothPatch tiltedPatch() {
    ClothPatch patch = levelPatch(5, 0.3);
    patch.origin.setY(btScalar(0.01));
    patch.edgeU.setY(btScalar(0.05));
    return patch;
  }

  btBoxShape m_box;
  btRigidBody m_floor;

 public:
  ClothScene scene;  // goes before the floor
};

inline WaterSurface waterUpTo(double level) {
  WaterSurface surface;
  surface.offset = -level;
  return surface;
}

}  // namespace wetcloth_test::parameters
