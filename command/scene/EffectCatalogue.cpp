// SPDX-License-Identifier: Zlib
#include "command/scene/EffectCatalogue.h"

#include "command/scene/EffectGroups.h"

#include <cmath>

namespace command {
namespace {

std::string keysText(const KeyTable& table) {
  std::string text;
  for (const std::string& key : table.keys) text += (text.empty() ? "`" : ", `") + key + "`";
  return text.empty() ? "none" : text;
}

std::string needsText(const EffectNeeds& needs) {
  std::string text;
  const auto add = [&](bool isNeeded, const char* word) {
    if (isNeeded) text += (text.empty() ? "" : ", ") + std::string(word);
  };
  add(needs.water, "`water`");
  add(needs.faces, "faces");
  add(needs.links, "links");
  add(needs.contacts, "contacts");
  return text;
}

std::string waterText(WaterRole role) {
  switch (role) {
    case WaterRole::none: break;
    case WaterRole::brings: return "brings";
    case WaterRole::moves: return "moves";
    case WaterRole::takes: return "takes";
  }
  return "";
}

/// A key that ends with its unit tells that it is a speed.
double speedsIn(const Json& value) {
  if (!value.is_object()) return 0;
  double sum = 0;
  for (const auto& [key, part] : value.items()) {
    const std::string unit = "_m_s";
    const bool isSpeed = key.size() > unit.size() && key.compare(key.size() - unit.size(), unit.size(), unit) == 0;
    if (!isSpeed) {
      sum += speedsIn(part);
    } else if (part.is_number()) {
      sum += std::abs(part.get<double>());
    } else {
      for (const Json& coordinate : part) sum += coordinate.is_number() ? std::abs(coordinate.get<double>()) : 0;
    }
  }
  return sum;
}

}  // namespace

const EffectCatalogue& effectCatalogue() {
  static const EffectCatalogue catalogue = [] {
    EffectCatalogue all;
    for (const auto& group : {springEffects(), sourceEffects(), transportEffects(), lossEffects(), materialEffects(),
                              forceEffects(), contactEffects(), auditEffects()}) {
      all.insert(all.end(), group.begin(), group.end());
    }
    return all;
  }();
  return catalogue;
}

std::vector<EffectScene> readEffects(JsonCursor cursor, const EffectContext& context,
                                     const EffectCatalogue& catalogue) {
  const KeyTable keys = effectKeys(catalogue);
  cursor.expectObject(keys);
  const EffectContext among{context.scene, context.cloth, &cursor};
  std::vector<EffectScene> effects;
  for (const EffectEntry& entry : catalogue) {
    auto found = cursor.find(entry.key);
    if (!found) continue;
    found->expectObject(entry.keys);
    if (entry.needs.water && !context.scene.water) found->complain("the scene must say where its water is, /water");
    effects.push_back({entry.key, entry.read(*found, among), entry.water, speedsIn(found->json())});
  }
  return effects;
}

KeyTable effectKeys(const EffectCatalogue& catalogue) {
  KeyTable table{"effects", {}};
  for (const EffectEntry& entry : catalogue) table.keys.push_back(entry.key);
  return table;
}

std::string effectTable(const EffectCatalogue& catalogue) {
  std::string text = "| effect | keys | needs | water | note |\n|---|---|---|---|---|\n";
  for (const EffectEntry& entry : catalogue) {
    text += "| `" + entry.key + "` | " + keysText(entry.keys) + " | " + needsText(entry.needs) + " | " +
            waterText(entry.water) + " | " + entry.about + " |\n";
  }
  return text;
}

}  // namespace command
