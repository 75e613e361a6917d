// SPDX-License-Identifier: Zlib
#include "command/scene/EffectGroups.h"

#include "command/scene/ReadParameters.h"

namespace command {
namespace {

using wetcloth::WetFriction;

AddEffect readWetFriction(const JsonCursor& cursor, const EffectContext&) {
  WetFriction::Parameters parameters;
  readNumber(cursor, "wet_factor", Range::notNegative(), parameters.wetFactor);
  readNumber(cursor, "peak_saturation", Range::positiveFraction(), parameters.peakSaturation);
  readNumber(cursor, "flooded_factor", Range::notNegative(), parameters.floodedFactor);
  return addEffect<WetFriction>(parameters);
}

EffectEntry wetFriction() {
  EffectEntry entry;
  entry.key = "wet_friction";
  entry.about = "factors on the friction of contacts";
  entry.keys = {"wetFriction", {"wet_factor", "peak_saturation", "flooded_factor"}};
  entry.read = readWetFriction;
  entry.byDefault = addDefault<WetFriction>;
  entry.needs.contacts = true;
  return entry;
}

}  // namespace

EffectCatalogue contactEffects() { return {wetFriction()}; }

}  // namespace command
