// SPDX-License-Identifier: Zlib
#pragma once

#include "command/viewer/EffectClock.h"

#include "command/scene/EffectCatalogue.h"
#include "command/scene/SceneWorld.h"

#include <cstddef>
#include <string>
#include <vector>

namespace viewer {

/// The effects of a scene's cloths, which can be turned on and off while it runs, and all others of the catalogue that
/// need nothing from the scene. An effect that the scene names belongs to the cloths that it names it for; another one
/// to all of them.
class EffectSwitches {
 public:
  struct Switch {
    std::string key;  ///< as scenes spell it
    bool isInScene = false;
    bool isOn = false;           ///< as it was turned last
    bool waitsForReset = false;  ///< for what it was turned to
    std::string refusal;         ///< why the library did not take it; empty: it did
  };

  explicit EffectSwitches(const command::Scene& scene,
                          const command::EffectCatalogue& catalogue = command::effectCatalogue());
  EffectSwitches(const EffectSwitches&) = delete;
  EffectSwitches& operator=(const EffectSwitches&) = delete;

  /// Gives a copy of the scene the effects that are on, so that its world tells us of them. The world must not outlive
  /// this.
  void equip(command::Scene& scene);

  const std::vector<Switch>& list() const { return m_switches; }
  /// As the scene has them, when it is next equipped.
  void restore();
  /// Per step of the scene [us].
  double microseconds(std::size_t index) const { return m_clock.microseconds(m_rows[index].part); }
  /// Masses, momentum and links, once the water has moved [us].
  double commitMicroseconds() const { return m_clock.microseconds(m_commit); }
  EffectClock& clock() { return m_clock; }
  const EffectClock& clock() const { return m_clock; }

  /// Adds an effect to its cloths or removes it. When the library refuses it, it stays off and the switch says why.
  void turn(std::size_t index, bool on, command::SceneWorld& world);

 private:
  /// What stands in a cloth for an effect: the effect and its laps.
  struct Placed {
    wetcloth::WetCloth* cloth;
    wetcloth::Effect* effect;
  };
  struct Row {
    EffectClock::Part part;
    std::vector<command::EffectScene> perCloth;  // nothing to add: not for this cloth
    std::vector<Placed> placed;
  };

  wetcloth::Effect& place(std::size_t index, std::size_t clothIndex, wetcloth::WetCloth& cloth,
                          const command::Colliders& colliders);
  void removeFrom(wetcloth::WetCloth& cloth, Row& row);
  command::EffectScene effectScene(std::size_t index, std::size_t cloth);
  command::EffectScene beginning(wetcloth::Stage stage);
  command::EffectScene commitEnd();

  bool m_isDeformable;
  EffectClock m_clock;
  EffectClock::Part m_commit;
  std::vector<Switch> m_switches;
  std::vector<Row> m_rows;  // one for each switch
};

}  // namespace viewer
