// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/JsonCursor.h"
#include "command/scene/ReadParameters.h"
#include "command/scene/Scene.h"
#include "command/scene/SceneKeys.h"

#include <functional>
#include <string>
#include <vector>

namespace command {

/// What the objects of a cloth's effects may refer to; read before them.
struct EffectContext {
  const Scene& scene;                   ///< its water and colliders
  const ClothScene& cloth;              ///< its shape
  const JsonCursor* effects = nullptr;  ///< of the cloth, from readEffects() on
};

/// What of its cloth or its scene an effect cannot do without: the library refuses it there.
struct EffectNeeds {
  bool water = false;     ///< the scene's /water
  bool faces = false;     ///< triangles of the cloth
  bool links = false;     ///< links of the cloth
  bool contacts = false;  ///< that Bullet lists contacts of the cloth: its "collisions"
};

/// All that the command knows of one effect.
struct EffectEntry {
  std::string key;                   ///< as scenes spell it: "wet_friction" for the class WetFriction
  std::string about;                 ///< for docs/scenes.md
  KeyTable keys;                     ///< of its object in a scene; its name is that in the schema
  std::vector<KeyTable> parts = {};  ///< of objects within that one which no other effect has
  /// Reads its object, whose keys are checked already.
  std::function<AddEffect(const JsonCursor& object, const EffectContext& context)> read;
  /// With the library's defaults, for the viewer's menu; empty: only a scene can say where or with what.
  std::function<AddEffect(const Scene& scene)> byDefault = {};
  Json example = Json::object();  ///< the least that a scene can say; `wetcloth cost` measures it
  EffectNeeds needs = {};
  WaterRole water = WaterRole::none;
};

/// In the order in which effects are added to a cloth, and shown.
using EffectCatalogue = std::vector<EffectEntry>;

/// Every effect of the library; springs before what changes them. Whoever takes a catalogue takes a longer one, too.
const EffectCatalogue& effectCatalogue();

/// For EffectEntry::byDefault.
template <class E>
AddEffect addDefault(const Scene&) {
  return addEffect<E>({});
}

/// Reads a cloth's "effects": only the named ones are there, in the order of the catalogue.
std::vector<EffectScene> readEffects(JsonCursor cursor, const EffectContext& context,
                                     const EffectCatalogue& catalogue = effectCatalogue());

/// The keys that "effects" may have.
KeyTable effectKeys(const EffectCatalogue& catalogue);

/// The table of docs/scenes.md.
std::string effectTable(const EffectCatalogue& catalogue);

}  // namespace command
