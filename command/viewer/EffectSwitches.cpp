// SPDX-License-Identifier: Zlib
#include "command/viewer/EffectSwitches.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

namespace viewer {
namespace {

using wetcloth::Effect;
using wetcloth::Stage;
using wetcloth::WetCloth;

const command::EffectScene* find(const command::ClothScene& cloth, const std::string& key) {
  for (const command::EffectScene& effect : cloth.effects) {
    if (effect.key == key) return &effect;
  }
  return nullptr;
}

bool isNamed(const command::Scene& scene, const std::string& key) {
  return std::any_of(scene.cloths.begin(), scene.cloths.end(),
                     [&](const command::ClothScene& cloth) { return cloth.hasEffect(key); });
}

Effect& add(WetCloth& cloth, std::unique_ptr<Effect> effect) { return cloth.add(std::move(effect)); }

}  // namespace

EffectSwitches::EffectSwitches(const command::Scene& scene, const command::EffectCatalogue& catalogue)
    : m_isDeformable(scene.world == command::WorldKind::deformable), m_commit(m_clock.addPart()) {
  for (const command::EffectEntry& offered : catalogue) {
    const bool named = isNamed(scene, offered.key);
    if (!named && !offered.byDefault) continue;
    m_switches.push_back({offered.key, named, named, false, ""});
    Row row{m_clock.addPart(), {}, {}};
    for (const command::ClothScene& cloth : scene.cloths) {
      const command::EffectScene* own = find(cloth, offered.key);
      const command::EffectScene other{offered.key, named ? command::AddEffect() : offered.byDefault(scene)};
      row.perCloth.push_back(own != nullptr ? *own : other);
    }
    m_rows.push_back(std::move(row));
  }
}

void EffectSwitches::equip(command::Scene& scene) {
  for (Row& row : m_rows) row.placed.clear();
  for (Switch& each : m_switches) each.waitsForReset = false;
  for (std::size_t cloth = 0; cloth < scene.cloths.size(); ++cloth) {
    std::vector<command::EffectScene>& effects = scene.cloths[cloth].effects;
    effects = {beginning(Stage::observe), beginning(Stage::sources), commitEnd()};
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
      if (m_switches[i].isOn && m_rows[i].perCloth[cloth].addTo) effects.push_back(effectScene(i, cloth));
    }
  }
}

void EffectSwitches::restore() {
  for (Switch& each : m_switches) each.isOn = each.isInScene;
}

command::EffectScene EffectSwitches::effectScene(std::size_t index, std::size_t cloth) {
  command::EffectScene effect = m_rows[index].perCloth[cloth];
  effect.addTo = [this, index, cloth](WetCloth& wet, const command::Colliders& colliders) -> Effect& {
    return place(index, cloth, wet, colliders);
  };
  return effect;
}

command::EffectScene EffectSwitches::beginning(Stage stage) {
  return {"", [this, stage](WetCloth& cloth, const command::Colliders&) -> Effect& {
            return add(cloth, m_clock.beginning(stage));
          }};
}

/// The first of the stage after it.
command::EffectScene EffectSwitches::commitEnd() {
  return {"", [this](WetCloth& cloth, const command::Colliders&) -> Effect& {
            return add(cloth, m_clock.endOf(m_commit, Stage::forces));
          }};
}

Effect& EffectSwitches::place(std::size_t index, std::size_t clothIndex, WetCloth& cloth,
                              const command::Colliders& colliders) {
  Row& row = m_rows[index];
  const command::AddEffect& addTo = row.perCloth[clothIndex].addTo;
  Effect* effect = &addTo(cloth, colliders);
  // Bullet's collision detection lies between the stages before and `contact`, so effects there need a beginning; only
  // an effect that was added tells its stage.
  if (effect->stage() == Stage::contact) {
    cloth.remove(*effect);
    row.placed.push_back({&cloth, &add(cloth, m_clock.beginning(Stage::contact))});
    effect = &addTo(cloth, colliders);
  }
  row.placed.push_back({&cloth, effect});
  row.placed.push_back({&cloth, &add(cloth, m_clock.endOf(row.part, effect->stage()))});
  return *effect;
}

void EffectSwitches::removeFrom(WetCloth& cloth, Row& row) {
  for (const Placed& placed : row.placed) {
    if (placed.cloth == &cloth) cloth.remove(*placed.effect);
  }
  row.placed.erase(std::remove_if(row.placed.begin(), row.placed.end(),
                                  [&](const Placed& placed) { return placed.cloth == &cloth; }),
                   row.placed.end());
}

void EffectSwitches::turn(std::size_t index, bool on, command::SceneWorld& world) {
  Switch& turned = m_switches.at(index);
  turned.refusal.clear();
  if (turned.isOn == on) return;
  turned.isOn = on;
  // Bullet's own springs are made with the deformable world, where the scene has no others.
  if (m_isDeformable && turned.key == "hooke_springs") {
    turned.waitsForReset = !turned.waitsForReset;
    return;
  }
  try {
    for (std::size_t i = 0; i < world.cloths().size(); ++i) {
      if (!on) removeFrom(*world.cloths()[i], m_rows[index]);
      if (on && m_rows[index].perCloth[i].addTo) place(index, i, *world.cloths()[i], world.colliders());
    }
  } catch (const std::invalid_argument& refused) {
    turned.isOn = false;
    turned.refusal = refused.what();
    for (WetCloth* cloth : world.cloths()) removeFrom(*cloth, m_rows[index]);
  }
}

}  // namespace viewer
