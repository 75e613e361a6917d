// SPDX-License-Identifier: Zlib
#include "command/scene/EffectReaders.h"

#include "command/scene/ReadParameters.h"

namespace command {

using wetcloth::Cling;
using wetcloth::WaterDrag;
using wetcloth::Wind;

AddEffect readWind(JsonCursor cursor, const EffectContext&) {
  using Law = Wind::Law;
  using Integration = Wind::Integration;
  static const std::vector<std::pair<std::string, Law>> laws{
      {"quadratic", Law::quadratic}, {"linear", Law::linear}, {"paper", Law::paper}};
  static const std::vector<std::pair<std::string, Integration>> integrations{
      {"semi_implicit", Integration::semiImplicit}, {"explicit_euler", Integration::explicitEuler}};
  cursor.expectObject(keys::wind);
  Wind::Parameters parameters;
  if (readMode(cursor) == Mode::paper) parameters.law = Law::paper;
  parameters.velocity = readWindField(cursor);
  if (const auto law = cursor.find("law")) parameters.law = law->choice(laws);
  if (const auto found = cursor.find("integration")) parameters.integration = found->choice(integrations);
  readNumber(cursor, "air_density_kg_m3", Range::notNegative(), parameters.airDensity);
  readNumber(cursor, "drag_coefficient", Range::notNegative(), parameters.dragCoefficient);
  readNumber(cursor, "skin_friction", Range::notNegative(), parameters.skinFriction);
  readNumber(cursor, "linear_drag_n_s_m3", Range::notNegative(), parameters.linearDrag);
  readNumber(cursor, "paper_force_n", Range::notNegative(), parameters.paperForce);
  return addEffect<Wind>(parameters);
}

AddEffect readWaterDrag(JsonCursor cursor, const EffectContext& context) {
  cursor.expectObject(keys::waterDrag);
  requireWater(cursor, context.scene);
  WaterDrag::Parameters parameters;
  readNumber(cursor, "drag_coefficient", Range::notNegative(), parameters.dragCoefficient);
  readNumber(cursor, "skin_friction", Range::notNegative(), parameters.skinFriction);
  readNumber(cursor, "fibre_density_kg_m3", Range::positive(), parameters.fibreDensity);
  return addEffect<WaterDrag>(parameters);
}

AddEffect readCling(JsonCursor cursor, const EffectContext&) {
  cursor.expectObject(keys::cling);
  Cling::Parameters parameters;
  readNumber(cursor, "adhesion_pa", Range::notNegative(), parameters.adhesion);
  readNumber(cursor, "shear_strength_pa", Range::notNegative(), parameters.shearStrength);
  readNumber(cursor, "minimum_saturation", Range{0, 1, true, "in [0, 1)", false}, parameters.minimumSaturation);
  readNumber(cursor, "peak_saturation", Range::positiveFraction(), parameters.peakSaturation);
  readNumber(cursor, "flooded_share", Range::fraction(), parameters.floodedShare);
  if (!(parameters.minimumSaturation < parameters.peakSaturation)) {
    const auto peak = cursor.find("peak_saturation");
    (peak ? *peak : cursor.at("minimum_saturation")).complain("minimum_saturation must be below peak_saturation");
  }
  return addEffect<Cling>(parameters);
}

}  // namespace command
