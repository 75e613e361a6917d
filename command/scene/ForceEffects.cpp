// SPDX-License-Identifier: Zlib
#include "command/scene/EffectGroups.h"

#include "command/scene/ReadParameters.h"

namespace command {
namespace {

using wetcloth::Cling;
using wetcloth::WaterDrag;
using wetcloth::Wind;

AddEffect readWind(const JsonCursor& cursor, const EffectContext&) {
  using Law = Wind::Law;
  using Integration = Wind::Integration;
  static const std::vector<std::pair<std::string, Law>> laws{
      {"quadratic", Law::quadratic}, {"linear", Law::linear}, {"paper", Law::paper}};
  static const std::vector<std::pair<std::string, Integration>> integrations{
      {"semi_implicit", Integration::semiImplicit}, {"explicit_euler", Integration::explicitEuler}};
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

EffectEntry wind() {
  EffectEntry entry;
  entry.key = "wind";
  entry.about =
      "`velocity_m_s`, or `gust`: `{\"mean_m_s\", \"amplitude_m_s\", \"period_s\"}`; `[0, 0, 0]` is still air, which "
      "resists; `\"mode\": \"paper\"` is n (n . wind), which knows neither area nor the cloth's own motion";
  entry.keys = {"wind",
                {"mode", "velocity_m_s", "gust", "law", "integration", "air_density_kg_m3", "drag_coefficient",
                 "skin_friction", "linear_drag_n_s_m3", "paper_force_n"}};
  entry.read = readWind;
  entry.byDefault = addDefault<Wind>;
  entry.example = {{"velocity_m_s", {2, 0, 1}}};
  entry.needs.faces = true;
  return entry;
}

AddEffect readWaterDrag(const JsonCursor& cursor, const EffectContext&) {
  WaterDrag::Parameters parameters;
  readNumber(cursor, "drag_coefficient", Range::notNegative(), parameters.dragCoefficient);
  readNumber(cursor, "skin_friction", Range::notNegative(), parameters.skinFriction);
  readNumber(cursor, "fibre_density_kg_m3", Range::positive(), parameters.fibreDensity);
  return addEffect<WaterDrag>(parameters);
}

EffectEntry waterDrag() {
  EffectEntry entry;
  entry.key = "water_drag";
  entry.about = "resistance and buoyancy below the scene's `water`";
  entry.keys = {"waterDrag", {"drag_coefficient", "skin_friction", "fibre_density_kg_m3"}};
  entry.read = readWaterDrag;
  entry.byDefault = addDefault<WaterDrag>;
  entry.needs.water = true;
  entry.needs.faces = true;
  return entry;
}

AddEffect readCling(const JsonCursor& cursor, const EffectContext&) {
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

EffectEntry cling() {
  EffectEntry entry;
  entry.key = "cling";
  entry.about = "holds wet nodes on colliders until they are pulled off";
  entry.keys = {"cling",
                {"adhesion_pa", "shear_strength_pa", "minimum_saturation", "peak_saturation", "flooded_share"}};
  entry.read = readCling;
  entry.byDefault = addDefault<Cling>;
  entry.needs.contacts = true;
  return entry;
}

}  // namespace

EffectCatalogue forceEffects() { return {wind(), waterDrag(), cling()}; }

}  // namespace command
