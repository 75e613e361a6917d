// SPDX-License-Identifier: Zlib
#include "command/scene/EffectGroups.h"

#include "command/scene/ReadParameters.h"

namespace command {
namespace {

using wetcloth::HookeSprings;

AddEffect readHookeSprings(const JsonCursor& cursor, const EffectContext&) {
  HookeSprings::Parameters parameters;
  readNumber(cursor, "stiffness_n_m", Range::positive(), parameters.stiffness);
  readNumber(cursor, "bending_stiffness_n_m", Range::notNegative(), parameters.bendingStiffness);
  if (const auto iterations = cursor.find("iterations")) parameters.iterations = iterations->integer(1, 10000);
  return addEffect<HookeSprings>(parameters);
}

EffectEntry hookeSprings() {
  EffectEntry entry;
  entry.key = "hooke_springs";
  entry.about = "links become springs that stretch under the weight of water";
  entry.keys = {"hookeSprings", {"stiffness_n_m", "bending_stiffness_n_m", "iterations"}};
  entry.read = readHookeSprings;
  entry.byDefault = addDefault<HookeSprings>;
  entry.needs.links = true;
  return entry;
}

}  // namespace

EffectCatalogue springEffects() { return {hookeSprings()}; }

}  // namespace command
