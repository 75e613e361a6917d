#include "EffectReaders.h"

#include "ReadParameters.h"

namespace runner {

using wetcloth::Absorption;

AddEffect readAbsorption(JsonCursor cursor, int nodes) {
  using Law = Absorption::Law;
  static const std::vector<std::pair<std::string, Law>> laws{
      {"exponential", Law::exponential}, {"forward_euler", Law::forwardEuler}, {"ramp", Law::ramp}};
  cursor.expectObject(keys::absorption);
  Absorption::Parameters parameters;
  if (readMode(cursor) == Mode::paper) parameters = Absorption::Parameters::paper();
  if (const auto exposure = cursor.find("exposure")) parameters.exposure = readExposure(*exposure, nodes);
  if (const auto law = cursor.find("law")) parameters.law = law->choice(laws);
  if (const auto water = cursor.find("water_velocity_m_s")) parameters.waterVelocity = readVector(*water);
  if (const auto conserves = cursor.find("conserves_momentum")) {
    parameters.conservesMomentum = conserves->boolean();
  }
  readNumber(cursor, "ramp_duration_s", Range::positive(), parameters.rampDuration);
  return addEffect<Absorption>(parameters);
}

}  // namespace runner
