// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/JsonCursor.h"
#include "command/scene/SceneWorld.h"

#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace wetcloth_python {

/// A scene that Python steps. What it says of a cloth is by the cloth's place in the scene.
///
/// Threads may share it: each call waits for the one before. Arrays that were handed out are not guarded: who reads
/// them while another thread steps sees some nodes before and some after.
class PythonScene {
 public:
  /// @param json  what a scene file holds; @param file  that complaints name. Throws command::InputError.
  PythonScene(command::Json json, const std::string& file);
  PythonScene(const PythonScene&) = delete;
  PythonScene& operator=(const PythonScene&) = delete;

  const command::Scene& scene() const { return m_scene; }
  const command::SceneWorld& world() const { return m_world; }
  const btSoftBody& body(std::size_t cloth) const { return *m_world.bodies()[cloth]; }
  const wetcloth::WetCloth& cloth(std::size_t cloth) const { return *m_world.cloths()[cloth]; }

  /// One step of the scene. @param left  of the steps that are asked for, this one included: with the last of them the
  /// pins are where they were sent. Throws command::RunError when a cloth blows up: the scene is then as it left it.
  void step(int left = 1);

  /// The whole state between two steps, to go on from in a scene of the same file. Throws wetcloth::StateError.
  std::string save() const;
  /// Throws wetcloth::StateError when the bytes are not such a state; then nothing has changed.
  void restore(const std::string& bytes);

  /// The nodes that are pinned, whose places are given by movePins().
  const std::vector<int>& pins(std::size_t cloth) const { return m_pins[cloth].nodes; }
  /// Where the pins are to be when the next call of step() ends; they go there at an even speed. Throws
  /// std::invalid_argument naming the pin and the value, or when the scene itself moves them.
  void movePins(std::size_t cloth, std::vector<btVector3> places);

  /// The effects of a cloth as a scene file would have them.
  command::Json effects(std::size_t cloth) const;
  /// Changes what is said of an effect (JSON merge patch: null takes a key away), or adds it. Throws
  /// command::InputError as for a file; then nothing has changed.
  void change(std::size_t cloth, const std::string& effect, const command::Json& patch);
  /// Throws std::invalid_argument when the cloth does not have it.
  void remove(std::size_t cloth, const std::string& effect);

  /// Water of each node [kg]. Throws std::invalid_argument as wetcloth::WetCloth::setHeld() does.
  void setWater(std::size_t cloth, const std::vector<double>& held);

  /// Diffuse colour of each node, linear RGB, into an array that stays at its place.
  const std::vector<float>& colours(std::size_t cloth);

 private:
  struct Pins {
    std::vector<int> nodes;
    std::vector<btVector3> goals;  // empty: they stay where they are
  };

  void pullPins(int substepsLeft);
  command::Json& effectsOf(std::size_t cloth);

  mutable std::mutex m_mutex;
  command::Json m_json;
  command::Scene m_scene;
  command::SceneWorld m_world;
  std::vector<Pins> m_pins;
  std::vector<std::vector<float>> m_colours;
  double m_pinSpeed = 0;  // the fastest so far [m/s]
};

}  // namespace wetcloth_python
