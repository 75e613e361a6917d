#include "EffectReader.h"

#include "EffectReaders.h"

namespace runner {
namespace {

struct EffectKey {
  const char* key;
  AddEffect (*read)(JsonCursor cursor, int nodes);
};

/// In the order of a step; springs before what changes them.
const EffectKey effectKeys[] = {{"absorption", readAbsorption},
                                {"wind", readWind},
                                {"hooke_springs", readHookeSprings},
                                {"collision_audit", readCollisionAudit}};

}  // namespace

std::vector<EffectScene> readEffects(JsonCursor cursor, int nodes) {
  cursor.expectObject(keys::effects);
  std::vector<EffectScene> effects;
  for (const EffectKey& effect : effectKeys) {
    if (const auto found = cursor.find(effect.key)) effects.push_back({effect.key, effect.read(*found, nodes)});
  }
  return effects;
}

}  // namespace runner
