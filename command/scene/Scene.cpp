// SPDX-License-Identifier: Zlib
#include "command/scene/Scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace command {

const NamedValues<WorldKind>& worldNames() {
  static const NamedValues<WorldKind> names{{"soft_rigid", WorldKind::softRigid},
                                            {"soft_multibody", WorldKind::softMultiBody},
                                            {"deformable", WorldKind::deformable}};
  return names;
}

const NamedValues<SolverKind>& solverNames() {
  static const NamedValues<SolverKind> names{{"bullet", SolverKind::bullet}, {"wetcloth", SolverKind::wetcloth}};
  return names;
}

void choose(SolverKind solver, std::optional<wetcloth::ClothSolver::Parameters>& chosen) {
  if (solver == SolverKind::bullet) {
    chosen.reset();
  } else if (!chosen) {
    chosen.emplace();
  }
}

void ClothScene::makeOf(const wetcloth::Fabric& other) {
  fabric = other;
  if (auto* patch = std::get_if<wetcloth::ClothPatch>(&shape)) patch->arealDensity = fabric.arealDensity;
  if (!garment) return;
  garment->fabrics.front() = fabric;
  auto& densities = std::get<TriangleMesh>(shape).arealDensities;
  for (std::size_t i = 0; i < densities.size(); ++i) {
    if (garment->fabricOfTriangle[i] == 0) densities[i] = fabric.arealDensity;
  }
}

void ClothScene::makeDry() {
  initialSaturation = 0;
  wetRegions.clear();
}

bool ClothScene::hasEffect(const std::string& key) const {
  return std::any_of(effects.begin(), effects.end(), [&](const EffectScene& effect) { return effect.key == key; });
}

int ClothScene::nodeCount() const {
  if (const auto* patch = std::get_if<wetcloth::ClothPatch>(&shape)) return patch->nodeCount();
  return static_cast<int>(std::get<TriangleMesh>(shape).vertices.size());
}

std::vector<btVector3> ClothScene::nodePositions() const {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) return mesh->vertices;
  const auto& patch = std::get<wetcloth::ClothPatch>(shape);
  std::vector<btVector3> positions;
  for (int j = 0; j < patch.rows; ++j) {
    for (int i = 0; i < patch.columns; ++i) {
      positions.push_back(patch.origin + patch.edgeU * btScalar(i) / btScalar(patch.columns - 1) +
                          patch.edgeV * btScalar(j) / btScalar(patch.rows - 1));
    }
  }
  return positions;
}

bool ClothScene::hasPins() const {
  const auto* patch = std::get_if<wetcloth::ClothPatch>(&shape);
  if (patch == nullptr) return !pinnedNodes.empty();
  return !(patch->pinnedCorners.empty() && patch->pinnedEdges.empty() && patch->pinnedNodes.empty());
}

double ClothScene::fastestPush() const {
  double speed = 10;  // of what has no speed of its own in the scene, such as rain
  for (const EffectScene& effect : effects) speed += effect.speed;
  if (motion) {
    for (std::size_t i = 1; i < motion->times.size(); ++i) {
      const double way = static_cast<double>((motion->offsets[i] - motion->offsets[i - 1]).length());
      speed = std::max(speed, way / (motion->times[i] - motion->times[i - 1]));
    }
  }
  if (twist) {
    const auto& patch = std::get<wetcloth::ClothPatch>(shape);
    const double reach = static_cast<double>(patch.edgeU.length() + patch.edgeV.length());
    speed += 2 * SIMD_PI * std::abs(twist->turnsPerSecond) * reach;
    if (twist->turns > 0) speed += twist->approach * std::abs(twist->turnsPerSecond) / twist->turns;
  }
  return speed;
}

bool Scene::hasGarments() const {
  return std::any_of(cloths.begin(), cloths.end(), [](const ClothScene& cloth) { return cloth.garment.has_value(); });
}

btVector3 Scene::up() const { return gravity.length() > 0 ? btVector3(-gravity.normalized()) : btVector3(0, 1, 0); }

std::string nameOf(WorldKind world) { return nameIn(worldNames(), world); }
std::string nameOf(SolverKind solver) { return nameIn(solverNames(), solver); }

}  // namespace command
