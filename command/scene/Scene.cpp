// SPDX-License-Identifier: Zlib
#include "command/scene/Scene.h"

#include <algorithm>

namespace command {

const NamedValues<WorldKind>& worldNames() {
  static const NamedValues<WorldKind> names{{"soft_rigid", WorldKind::softRigid},
                                            {"soft_multibody", WorldKind::softMultiBody},
                                            {"deformable", WorldKind::deformable}};
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

}  // namespace command
