// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/ReadParameters.h"
#include "command/viewer/LiveScene.h"

#include <gtest/gtest.h>

#include <string>

namespace wetcloth_test::viewer_scene {

/// A square towel that hangs by its upper edge, one metre wide, in the plane z = 0; dry, with no effect.
inline command::Scene hangingTowel(command::WorldKind world = command::WorldKind::softRigid) {
  command::Scene scene;
  scene.file = "towel.json";
  scene.name = "towel";
  scene.world = world;
  command::ClothScene cloth;
  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = 9;
  patch.origin = btVector3(0, 2, 0);
  patch.edgeU = btVector3(1, 0, 0);
  patch.edgeV = btVector3(0, -1, 0);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::bottom};
  patch.arealDensity = cloth.fabric.arealDensity;
  cloth.shape = patch;
  cloth.springs.stiffness = 20;  // Bullet's explicit springs want no more at this mass and step
  scene.cloths = {cloth};
  return scene;
}

template <class E>
void give(command::Scene& scene, const std::string& key, typename E::Parameters parameters = {}) {
  scene.cloths[0].effects.push_back({key, command::addEffect<E>(parameters)});
}

inline command::Scene soakingTowel(command::WorldKind world = command::WorldKind::softRigid) {
  command::Scene scene = hangingTowel(world);
  give<wetcloth::Absorption>(scene, "absorption");
  wetcloth::Wind::Parameters wind;
  wind.velocity = btVector3(1, 0, 3);
  give<wetcloth::Wind>(scene, "wind", wind);
  return scene;
}

inline void run(viewer::LiveScene& live, int steps) {
  for (int i = 0; i < steps; ++i) live.step();
}

inline std::size_t indexOf(const viewer::LiveScene& live, const std::string& key) {
  const auto& list = live.effects().list();
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].key == key) return i;
  }
  ADD_FAILURE() << "no switch for " << key;
  return 0;
}

inline const viewer::EffectSwitches::Switch& switchOf(const viewer::LiveScene& live, const std::string& key) {
  return live.effects().list()[indexOf(live, key)];
}

/// From the front, at a place of the towel's plane.
inline viewer::Ray rayAt(double x, double y) { return {btVector3(btScalar(x), btScalar(y), 5), btVector3(0, 0, -1)}; }

/// Each of Bullet's three worlds.
using InEachWorld = testing::TestWithParam<command::WorldKind>;

inline const auto allWorlds =
    testing::Values(command::WorldKind::softRigid, command::WorldKind::softMultiBody, command::WorldKind::deformable);

inline std::string worldName(const testing::TestParamInfo<command::WorldKind>& info) {
  return command::nameOf(info.param);
}

}  // namespace wetcloth_test::viewer_scene
