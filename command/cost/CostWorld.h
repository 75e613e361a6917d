// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/SceneWorld.h"

#include <memory>
#include <string>
#include <vector>

namespace command {

/// A scene of which some effects are left out, and whose steps are timed: by the processor's time spent on them, so
/// that a process which takes the core for a while does not count.
class CostWorld {
 public:
  struct Seconds {
    double step = 0;  ///< the whole step
    double ours = 0;  ///< until the last effect was done; 0 without a stopwatch
  };

  /// The scene in Bullet alone.
  static CostWorld plain(const Scene& scene) { return CostWorld(scene, SceneWorld::Kind::plainBullet); }
  /// Wrapped by the library, which has nothing to do: dry, without effects, and without the solver's guard.
  static CostWorld idle(const Scene& scene);
  /// The name of the solver's guard beside those of the effects.
  static constexpr const char* guard = "guard";
  /// And that of the drops.
  static constexpr const char* drops = "drops";
  /// With all effects, the guard and the drops but the one of this name, if it has a name, and a stopwatch.
  static CostWorld timed(const Scene& scene, const std::string& without = "");

  const SceneWorld& world() const { return *m_world; }
  Seconds step();

 private:
  class Stopwatch;

  CostWorld(const Scene& scene, SceneWorld::Kind kind)
      : m_scene(std::make_unique<const Scene>(scene)), m_world(std::make_unique<SceneWorld>(*m_scene, kind)) {}

  std::unique_ptr<const Scene> m_scene;
  std::unique_ptr<SceneWorld> m_world;
  const Stopwatch* m_stopwatch = nullptr;
};

/// The names of a world's effects as a scene spells them, "hooke_springs", each once, in the order of the step; last,
/// where the solver has one, its guard, and where the scene has them, its drops.
std::vector<std::string> effectNames(const SceneWorld& world);

}  // namespace command
