// SPDX-License-Identifier: Zlib
#include "command/scene/Scene.h"

#include <algorithm>
#include <utility>

namespace command {
namespace {

template <class Value>
std::string nameIn(const std::vector<std::pair<std::string, Value>>& names, Value wanted) {
  for (const auto& [name, value] : names) {
    if (value == wanted) return name;
  }
  return "";
}

}  // namespace

const std::vector<std::pair<std::string, WorldKind>>& worldNames() {
  static const std::vector<std::pair<std::string, WorldKind>> names{{"soft_rigid", WorldKind::softRigid},
                                                                    {"soft_multibody", WorldKind::softMultiBody},
                                                                    {"deformable", WorldKind::deformable}};
  return names;
}

const std::vector<std::pair<std::string, Precision>>& precisionNames() {
  static const std::vector<std::pair<std::string, Precision>> names{{"float32", Precision::float32},
                                                                    {"float64", Precision::float64}};
  return names;
}

bool ClothScene::hasEffect(const std::string& key) const {
  return std::any_of(effects.begin(), effects.end(), [&](const EffectScene& effect) { return effect.key == key; });
}

int ClothScene::nodeCount() const {
  if (const auto* patch = std::get_if<wetcloth::ClothPatch>(&shape)) return patch->nodeCount();
  return static_cast<int>(std::get<TriangleMesh>(shape).vertices.size());
}

bool ClothScene::hasPins() const {
  const auto* patch = std::get_if<wetcloth::ClothPatch>(&shape);
  if (patch == nullptr) return !pinnedNodes.empty();
  return !(patch->pinnedCorners.empty() && patch->pinnedEdges.empty() && patch->pinnedNodes.empty());
}

btVector3 Scene::up() const { return gravity.length() > 0 ? btVector3(-gravity.normalized()) : btVector3(0, 1, 0); }

std::string nameOf(WorldKind world) { return nameIn(worldNames(), world); }
std::string nameOf(Precision precision) { return nameIn(precisionNames(), precision); }

}  // namespace command
