// SPDX-License-Identifier: Zlib
#include "command/scene/EffectGroups.h"

#include "command/scene/ReadParameters.h"

namespace command {
namespace {

using wetcloth::Dripping;
using wetcloth::Drying;

AddEffect readDripping(const JsonCursor& cursor, const EffectContext&) {
  Dripping::Parameters parameters;
  readNumber(cursor, "holding_saturation", Range::fraction(), parameters.holdingSaturation);
  readNumber(cursor, "time_constant_s", Range::positive(), parameters.timeConstant);
  readNumber(cursor, "drop_mass_kg", Range::notNegative(), parameters.dropMass);
  readNumber(cursor, "slope_tolerance", Range::fraction(), parameters.slopeTolerance);
  readNumber(cursor, "squeeze", Range::fraction(), parameters.squeeze);
  return addEffect<Dripping>(parameters);
}

EffectEntry dripping() {
  EffectEntry entry;
  entry.key = "dripping";
  entry.about =
      "from low points; a level cloth drips everywhere; `squeeze`, [0, 1], lets water go where cloth is crumpled or "
      "wrung";
  entry.keys = {"dripping", {"holding_saturation", "time_constant_s", "drop_mass_kg", "slope_tolerance", "squeeze"}};
  entry.read = readDripping;
  entry.byDefault = addDefault<Dripping>;
  entry.needs.faces = true;
  entry.water = WaterRole::takes;
  return entry;
}

AddEffect readDrying(const JsonCursor& cursor, const EffectContext& context) {
  Drying::Parameters parameters;
  readNumber(cursor, "temperature_c", Range{0, 60, true, "in [0, 60]"}, parameters.temperature);
  readNumber(cursor, "relative_humidity", Range::fraction(), parameters.relativeHumidity);
  if (cursor.find("velocity_m_s") || cursor.find("gust")) parameters.air = readWindField(cursor);
  readNumber(cursor, "self_cooling", Range::positiveFraction(), parameters.selfCooling);
  readNumber(cursor, "critical_saturation", Range::positiveFraction(), parameters.criticalSaturation);
  readNumber(cursor, "equilibrium_saturation",
             Range{0, parameters.criticalSaturation, true, "in [0, critical_saturation)", false},
             parameters.equilibriumSaturation);
  readNumber(cursor, "sides", Range{0, 2, false, "in (0, 2]"}, parameters.sides);
  if (const auto exposure = cursor.find("exposure"))
    parameters.exposure = readExposure(*exposure, context.cloth.nodeCount());
  return addEffect<Drying>(parameters);
}

EffectEntry drying() {
  EffectEntry entry;
  entry.key = "drying";
  entry.about = "`exposure` as of `absorption`, the share that air reaches; `velocity_m_s` or `gust` as of `wind`";
  entry.keys = {"drying",
                {"temperature_c", "relative_humidity", "velocity_m_s", "gust", "self_cooling", "critical_saturation",
                 "equilibrium_saturation", "sides", "exposure"}};
  entry.read = readDrying;
  entry.byDefault = addDefault<Drying>;
  entry.needs.faces = true;
  entry.water = WaterRole::takes;
  return entry;
}

}  // namespace

EffectCatalogue lossEffects() { return {dripping(), drying()}; }

}  // namespace command
