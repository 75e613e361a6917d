// SPDX-License-Identifier: Zlib
#pragma once

#include "tests/command/Command.h"

#include <cmath>
#include <string>

namespace wetcloth_test::cli {

/// A square metre of the fabric of tests/scenes/small.json.
constexpr double dryMass = 0.15;             // [kg]
constexpr double capacity = 0.84 * dryMass;  // of water [kg]
constexpr double timeConstant = 8.844;       // of absorption [s]
constexpr double gravity = 9.81;             // [m/s^2]

inline Json& clothOf(Json& scene) { return scene["cloths"][0]; }

/// tests/scenes/small.json, level, at a height of 1 m, with these effects and without colliders.
inline Json levelScene(const Json& effects, double duration) {
  Json scene = smallScene();
  scene["duration_s"] = duration;
  scene["step_s"] = 0.02;
  scene.erase("colliders");
  clothOf(scene)["effects"] = effects;
  return scene;
}

/// The same without gravity.
inline Json floatingScene(const Json& effects, double duration) {
  Json scene = levelScene(effects, duration);
  scene["gravity_m_s2"] = {0, 0, 0};
  return scene;
}

/// Upright, from 1 m to 2 m, all nodes pinned: only water moves.
inline Json uprightScene(const Json& effects, double duration) {
  Json scene = levelScene(effects, duration);
  clothOf(scene)["patch"]["edge_v_m"] = {0, 1, 0};
  clothOf(scene)["pins"]["nodes"] = Json::array();
  for (int node = 0; node < 20; ++node) clothOf(scene)["pins"]["nodes"].push_back(node);
  return scene;
}

inline double timeOf(const Json& result) { return result.at("steps").get<double>() * result.at("dt").get<double>(); }
inline double ledger(const Json& result, const std::string& key) { return result.at("ledger").at(key).get<double>(); }
inline double saturation(const Json& result, const std::string& key) {
  return result.at("saturation").at(key).get<double>();
}
inline double centre(const Json& result, int axis) { return result.at("centre_of_mass").at(axis).get<double>(); }

}  // namespace wetcloth_test::cli
