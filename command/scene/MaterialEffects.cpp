// SPDX-License-Identifier: Zlib
#include "command/scene/EffectGroups.h"

#include "command/scene/ReadParameters.h"

namespace command {
namespace {

using wetcloth::Swelling;
using wetcloth::WetStiffness;

AddEffect readWetStiffness(const JsonCursor& cursor, const EffectContext&) {
  const Range factors{0.001, 1000, true, "in [0.001, 1000]"};
  WetStiffness::Parameters parameters;
  readNumber(cursor, "wet_stretch", factors, parameters.wetStretch);
  readNumber(cursor, "wet_bending", factors, parameters.wetBending);
  readNumber(cursor, "dry_damping_1_s", Range::notNegative(), parameters.dryDamping);
  readNumber(cursor, "wet_damping_1_s", Range::notNegative(), parameters.wetDamping);
  return addEffect<WetStiffness>(parameters);
}

EffectEntry wetStiffness() {
  EffectEntry entry;
  entry.key = "wet_stiffness";
  entry.about = "factors on the stiffness at saturation; damping along links";
  entry.keys = {"wetStiffness", {"wet_stretch", "wet_bending", "dry_damping_1_s", "wet_damping_1_s"}};
  entry.read = readWetStiffness;
  entry.byDefault = addDefault<WetStiffness>;
  entry.needs.links = true;
  return entry;
}

AddEffect readSwelling(const JsonCursor& cursor, const EffectContext&) {
  Swelling::Parameters parameters;
  readNumber(cursor, "saturated_strain", Range{-0.5, 0.5, false, "in (-0.5, 0.5)", false}, parameters.saturatedStrain);
  return addEffect<Swelling>(parameters);
}

EffectEntry swelling() {
  EffectEntry entry;
  entry.key = "swelling";
  entry.about = "negative: shrinks";
  entry.keys = {"swelling", {"saturated_strain"}};
  entry.read = readSwelling;
  entry.byDefault = addDefault<Swelling>;
  entry.needs.links = true;
  return entry;
}

}  // namespace

EffectCatalogue materialEffects() { return {wetStiffness(), swelling()}; }

}  // namespace command
