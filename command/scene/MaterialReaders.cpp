// SPDX-License-Identifier: Zlib
#include "command/scene/EffectReaders.h"

#include "command/scene/ReadParameters.h"

namespace command {

using wetcloth::HookeSprings;
using wetcloth::Swelling;
using wetcloth::WetFriction;
using wetcloth::WetStiffness;

AddEffect readHookeSprings(JsonCursor cursor, const EffectContext&) {
  cursor.expectObject(keys::hookeSprings);
  HookeSprings::Parameters parameters;
  readNumber(cursor, "stiffness_n_m", Range::positive(), parameters.stiffness);
  readNumber(cursor, "bending_stiffness_n_m", Range::notNegative(), parameters.bendingStiffness);
  if (const auto iterations = cursor.find("iterations")) parameters.iterations = iterations->integer(1, 10000);
  return addEffect<HookeSprings>(parameters);
}

AddEffect readWetStiffness(JsonCursor cursor, const EffectContext&) {
  cursor.expectObject(keys::wetStiffness);
  const Range factors{0.001, 1000, true, "in [0.001, 1000]"};
  WetStiffness::Parameters parameters;
  readNumber(cursor, "wet_stretch", factors, parameters.wetStretch);
  readNumber(cursor, "wet_bending", factors, parameters.wetBending);
  readNumber(cursor, "dry_damping_1_s", Range::notNegative(), parameters.dryDamping);
  readNumber(cursor, "wet_damping_1_s", Range::notNegative(), parameters.wetDamping);
  return addEffect<WetStiffness>(parameters);
}

AddEffect readSwelling(JsonCursor cursor, const EffectContext&) {
  cursor.expectObject(keys::swelling);
  Swelling::Parameters parameters;
  readNumber(cursor, "saturated_strain", Range{-0.5, 0.5, false, "in (-0.5, 0.5)", false}, parameters.saturatedStrain);
  return addEffect<Swelling>(parameters);
}

AddEffect readWetFriction(JsonCursor cursor, const EffectContext&) {
  cursor.expectObject(keys::wetFriction);
  WetFriction::Parameters parameters;
  readNumber(cursor, "wet_factor", Range::notNegative(), parameters.wetFactor);
  readNumber(cursor, "peak_saturation", Range::positiveFraction(), parameters.peakSaturation);
  readNumber(cursor, "flooded_factor", Range::notNegative(), parameters.floodedFactor);
  return addEffect<WetFriction>(parameters);
}

}  // namespace command
