// SPDX-License-Identifier: Zlib
#include "command/cost/CostScene.h"

#include "command/scene/EffectReader.h"
#include "command/scene/SceneKeys.h"

namespace command {
namespace {

/// From the table of keys, so that an effect that is new there is measured here.
Json everyEffect() {
  Json effects = Json::object();
  for (const std::string& key : keys::effects.keys) effects[key] = Json::object();
  effects["contact_wetting"]["films"] = {{{"collider", 0}, {"water_kg", 1}}};
  // The parameters without a default
  effects["wind"]["velocity_m_s"] = {2, 0, 1};
  effects["splash"] = {{"sphere", {{"centre_m", {0.5, 0.5, 0}}, {"radius_m", 0.2}}}, {"velocity_m_s", {0, 0, 5}}};
  return effects;
}

}  // namespace

Scene costScene() {
  Scene scene;
  scene.file = "wetcloth cost";
  scene.name = "built-in";
  scene.precision = ownPrecision;
  scene.water = WaterScene{0.1};
  scene.colliders.emplace_back(Sphere{btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.1)), 0.1});
  ClothScene cloth;
  cloth.initialSaturation = 0.7;
  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = 64;
  patch.edgeV = btVector3(0, 1, 0);
  patch.pinnedCorners = {wetcloth::ClothPatch::Corner::topLeft, wetcloth::ClothPatch::Corner::topRight};
  cloth.fabric = wetcloth::Fabric::cotton();
  patch.arealDensity = cloth.fabric.arealDensity;
  const Json effects = everyEffect();
  cloth.shape = patch;
  cloth.effects = readEffects(JsonCursor(effects, scene.file, "/cloths/0/effects"), {scene, cloth});
  scene.cloths.push_back(cloth);
  return scene;
}

}  // namespace command
