// SPDX-License-Identifier: Zlib
#include "command/scene/EffectReaders.h"

#include "command/scene/ReadParameters.h"

namespace command {

using wetcloth::Dripping;
using wetcloth::Drying;

AddEffect readDripping(JsonCursor cursor, const EffectContext&) {
  cursor.expectObject(keys::dripping);
  Dripping::Parameters parameters;
  readNumber(cursor, "holding_saturation", Range::fraction(), parameters.holdingSaturation);
  readNumber(cursor, "time_constant_s", Range::positive(), parameters.timeConstant);
  readNumber(cursor, "drop_mass_kg", Range::notNegative(), parameters.dropMass);
  readNumber(cursor, "slope_tolerance", Range::fraction(), parameters.slopeTolerance);
  return addEffect<Dripping>(parameters);
}

AddEffect readDrying(JsonCursor cursor, const EffectContext& context) {
  cursor.expectObject(keys::drying);
  Drying::Parameters parameters;
  readNumber(cursor, "temperature_c", Range{0, 60, true, "in [0, 60]"}, parameters.temperature);
  readNumber(cursor, "relative_humidity", Range::fraction(), parameters.relativeHumidity);
  if (cursor.find("velocity_m_s") || cursor.find("gust")) parameters.air = readWindField(cursor);
  readNumber(cursor, "self_cooling", Range::positiveFraction(), parameters.selfCooling);
  readNumber(cursor, "critical_saturation", Range::positiveFraction(), parameters.criticalSaturation);
  readNumber(cursor, "sides", Range{0, 2, false, "in (0, 2]"}, parameters.sides);
  if (const auto exposure = cursor.find("exposure"))
    parameters.exposure = readExposure(*exposure, context.cloth.nodeCount());
  return addEffect<Drying>(parameters);
}

}  // namespace command
