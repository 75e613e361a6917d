// SPDX-License-Identifier: Zlib
#include "command/cost/CostWorld.h"

#include "command/scene/LeaveOut.h"
#include "command/timing/ProcessorTime.h"

#include <algorithm>
#include <cctype>
#include <memory>
#include <utility>

namespace command {
namespace {

/// "HookeSprings" as "hooke_springs": a class as the scene's key for it.
std::string keyOf(const wetcloth::Effect& effect) {
  std::string key;
  for (const char* letter = effect.name(); *letter != '\0'; ++letter) {
    const auto code = static_cast<unsigned char>(*letter);
    if (std::isupper(code) != 0 && !key.empty()) key += '_';
    key += static_cast<char>(std::tolower(code));
  }
  return key;
}

void leaveOutGuard(Scene& scene) {
  if (scene.clothSolver) scene.clothSolver->guard.reset();
}

}  // namespace

/// The last effect of the last cloth: when it runs, our part of the step is over. Bullet's worlds call us before they
/// do anything else, so that part began, but for some hundred nanoseconds, with the step.
class CostWorld::Stopwatch : public wetcloth::Effect {
 public:
  const char* name() const override { return "Stopwatch"; }
  wetcloth::Stage stage() const override { return wetcloth::Stage::elasticity; }
  void apply(wetcloth::WetCloth&, const wetcloth::Step&) override { m_time = processorTime(); }
  double time() const { return m_time; }

 private:
  double m_time = 0;
};

CostWorld CostWorld::idle(const Scene& scene) {
  Scene bare = leaveOut(scene, [](const EffectScene&) { return true; });
  for (ClothScene& cloth : bare.cloths) cloth.makeDry();
  leaveOutGuard(bare);
  bare.drops.reset();
  return CostWorld(bare, SceneWorld::Kind::wet);
}

CostWorld CostWorld::timed(const Scene& scene, const std::string& without) {
  Scene rest = leaveOut(scene, [&](const EffectScene& effect) { return effect.key == without; });
  if (without == guard) leaveOutGuard(rest);
  if (without == drops) rest.drops.reset();
  CostWorld world(rest, SceneWorld::Kind::wet);
  auto stopwatch = std::make_unique<Stopwatch>();
  world.m_stopwatch = stopwatch.get();
  world.m_world->cloths().back()->add(std::move(stopwatch));
  return world;
}

CostWorld::Seconds CostWorld::step() {
  const double start = processorTime();
  m_world->step();
  const double end = processorTime();
  return {atLeastATick(end - start), m_stopwatch == nullptr ? 0 : m_stopwatch->time() - start};
}

std::vector<std::string> effectNames(const SceneWorld& world) {
  std::vector<std::string> names;
  for (const wetcloth::WetCloth* cloth : world.cloths()) {
    for (const wetcloth::Effect& effect : cloth->effects()) {
      const std::string key = keyOf(effect);
      if (std::find(names.begin(), names.end(), key) == names.end()) names.push_back(key);
    }
  }
  const wetcloth::ClothSolver* const solver = world.clothSolver();
  if (solver != nullptr && solver->parameters().guard) names.emplace_back(CostWorld::guard);
  if (world.drops() != nullptr) names.emplace_back(CostWorld::drops);
  return names;
}

}  // namespace command
