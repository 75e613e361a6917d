// SPDX-License-Identifier: Zlib
#include "python/PythonScene.h"

#include "command/cli/Errors.h"
#include "command/cli/NearestWord.h"
#include "command/scene/EffectCatalogue.h"
#include "command/scene/SceneReader.h"
#include "command/scene/SoundState.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace wetcloth_python {
namespace {

using command::InputError;
using command::Json;

/// "wet_friction" for the class WetFriction
std::string keyOf(const wetcloth::Effect& effect) {
  std::string key;
  for (const char* c = effect.name(); *c != '\0'; ++c) {
    const auto letter = static_cast<unsigned char>(*c);
    if (std::isupper(letter) != 0 && !key.empty()) key += '_';
    key += static_cast<char>(std::tolower(letter));
  }
  return key;
}

wetcloth::Effect* findEffect(wetcloth::WetCloth& cloth, const std::string& key) {
  for (wetcloth::Effect& effect : cloth.effects()) {
    if (keyOf(effect) == key) return &effect;
  }
  return nullptr;
}

const command::EffectEntry& entryOf(const std::string& key, const std::string& pointer) {
  std::vector<std::string> known;
  for (const command::EffectEntry& entry : command::effectCatalogue()) {
    if (entry.key == key) return entry;
    known.push_back(entry.key);
  }
  throw InputError(pointer + ": unknown effect; " + command::didYouMean(key, known) + "must be one of " +
                   command::joined(known));
}

/// Before the world's own state, which knows by itself whether it was changed.
struct StepsSaved {
  std::int32_t count = -1;
  std::int32_t complement = 0;
};

bool isMovedByTheScene(const command::ClothScene& cloth) { return cloth.twist || cloth.motion; }

}  // namespace

PythonScene::PythonScene(Json json, const std::string& file)
    : m_json(std::move(json)), m_scene(command::readScene(m_json, file)), m_world(m_scene) {
  for (const btSoftBody* body : m_world.bodies()) {
    Pins pins;
    for (int i = 0; i < body->m_nodes.size(); ++i) {
      if (body->m_nodes[i].m_im == 0) pins.nodes.push_back(i);
    }
    m_pins.push_back(std::move(pins));
    m_colours.emplace_back(3 * static_cast<std::size_t>(body->m_nodes.size()));
  }
}

/// The way that is left in equal parts.
void PythonScene::pullPins(int substepsLeft) {
  for (std::size_t c = 0; c < m_pins.size(); ++c) {
    Pins& pins = m_pins[c];
    for (std::size_t i = 0; i < pins.goals.size(); ++i) {
      btVector3& place = m_world.bodies()[c]->m_nodes[pins.nodes[i]].m_x;
      place += (pins.goals[i] - place) / btScalar(substepsLeft);
    }
  }
}

void PythonScene::step(int left) {
  const std::lock_guard<std::mutex> lock(m_mutex);
  const double time = left * m_scene.step;
  for (std::size_t c = 0; c < m_pins.size(); ++c) {
    for (std::size_t i = 0; i < m_pins[c].goals.size(); ++i) {
      const btVector3 way = m_pins[c].goals[i] - m_world.bodies()[c]->m_nodes[m_pins[c].nodes[i]].m_x;
      m_pinSpeed = std::max(m_pinSpeed, static_cast<double>(way.length()) / time);
    }
  }
  int substepsLeft = left * m_scene.substeps;
  m_world.step([&](btScalar) { pullPins(substepsLeft--); });
  if (left == 1) {
    for (Pins& pins : m_pins) pins.goals.clear();
  }
  const auto blowUp = command::describeBlowUp(m_world, m_pinSpeed);
  if (blowUp) throw command::RunError(m_scene.file + ": " + *blowUp);
}

std::string PythonScene::save() const {
  const std::lock_guard<std::mutex> lock(m_mutex);
  std::ostringstream stream;
  const StepsSaved steps{m_world.steps(), ~m_world.steps()};
  stream.write(reinterpret_cast<const char*>(&steps), sizeof steps);
  m_world.save(stream);
  return stream.str();
}

void PythonScene::restore(const std::string& bytes) {
  const std::lock_guard<std::mutex> lock(m_mutex);
  StepsSaved steps;
  if (bytes.size() >= sizeof steps) std::memcpy(&steps, bytes.data(), sizeof steps);
  if (steps.count < 0 || steps.complement != ~steps.count) {
    throw wetcloth::StateError("this is no saved state of a scene");
  }
  std::istringstream stream(bytes.substr(sizeof steps));
  m_world.restore(stream, steps.count);
  for (Pins& pins : m_pins) pins.goals.clear();
}

void PythonScene::movePins(std::size_t cloth, std::vector<btVector3> places) {
  const std::lock_guard<std::mutex> lock(m_mutex);
  Pins& pins = m_pins[cloth];
  if (isMovedByTheScene(m_scene.cloths[cloth])) {
    throw std::invalid_argument("the scene moves the pins of this cloth: it has a \"motion\" or a \"twist\"");
  }
  if (places.size() != pins.nodes.size()) {
    throw std::invalid_argument("places has " + std::to_string(places.size()) + " rows: must be " +
                                std::to_string(pins.nodes.size()) + ", one for each pin");
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!std::isfinite(places[i].length2())) {
      throw std::invalid_argument("places[" + std::to_string(i) + "]: must be finite");
    }
  }
  pins.goals = std::move(places);
}

Json& PythonScene::effectsOf(std::size_t cloth) {
  Json& effects = m_json["cloths"][cloth]["effects"];
  if (effects.is_null()) effects = Json::object();
  return effects;
}

Json PythonScene::effects(std::size_t cloth) const {
  const std::lock_guard<std::mutex> lock(m_mutex);
  const Json& scene = m_json["cloths"][cloth];
  return scene.contains("effects") ? scene["effects"] : Json::object();
}

void PythonScene::change(std::size_t cloth, const std::string& effect, const Json& patch) {
  const std::lock_guard<std::mutex> lock(m_mutex);
  const std::string pointer = "/cloths/" + std::to_string(cloth) + "/effects";
  entryOf(effect, m_scene.file + ": " + pointer + "/" + effect);
  Json effects = effectsOf(cloth);
  if (!effects.contains(effect)) effects[effect] = Json::object();
  effects[effect].merge_patch(patch);
  const command::EffectContext context{m_scene, m_scene.cloths[cloth]};
  const auto read = command::readEffects(command::JsonCursor(effects, m_scene.file, pointer), context);
  const auto wanted = std::find_if(read.begin(), read.end(), [&](const auto& each) { return each.key == effect; });
  try {
    wanted->addTo(*m_world.cloths()[cloth], m_world.colliders());
  } catch (const std::invalid_argument& refused) {
    throw InputError(command::onOneLine(m_scene.file + ": " + pointer + "/" + effect + ": " + refused.what()));
  }
  effectsOf(cloth) = std::move(effects);
  // Of what pushes a cloth a run that blew up is told by.
  auto& known = m_scene.cloths[cloth].effects;
  const auto there = std::find_if(known.begin(), known.end(), [&](const auto& each) { return each.key == effect; });
  if (there == known.end()) {
    known.push_back(*wanted);
  } else {
    *there = *wanted;
  }
}

void PythonScene::remove(std::size_t cloth, const std::string& effect) {
  const std::lock_guard<std::mutex> lock(m_mutex);
  wetcloth::WetCloth& wet = *m_world.cloths()[cloth];
  wetcloth::Effect* const there = findEffect(wet, effect);
  if (there == nullptr || !effectsOf(cloth).contains(effect)) {
    throw std::invalid_argument("the cloth has no effect \"" + effect + "\"");
  }
  wet.remove(*there);
  effectsOf(cloth).erase(effect);
}

void PythonScene::setWater(std::size_t cloth, const std::vector<double>& held) {
  const std::lock_guard<std::mutex> lock(m_mutex);
  m_world.cloths()[cloth]->setHeld(held);
}

const std::vector<float>& PythonScene::colours(std::size_t cloth) {
  const std::lock_guard<std::mutex> lock(m_mutex);
  const wetcloth::WetCloth& wet = *m_world.cloths()[cloth];
  std::vector<float>& colours = m_colours[cloth];
  wetcloth::VertexBuffer buffer;
  buffer.base = colours.data();
  buffer.vertexCount = wet.nodeCount();
  buffer.colour = {0, 3};
  wetcloth::fillVertexBuffer(wet, buffer);
  return colours;
}

}  // namespace wetcloth_python
