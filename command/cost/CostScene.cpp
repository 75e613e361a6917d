// SPDX-License-Identifier: Zlib
#include "command/cost/CostScene.h"

#include "command/scene/EffectCatalogue.h"

namespace command {
namespace {

Json everyEffect() {
  Json effects = Json::object();
  for (const EffectEntry& entry : effectCatalogue()) effects[entry.key] = entry.example;
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
