// SPDX-License-Identifier: Zlib
#include "command/run/DripRecord.h"

#include <cstddef>
#include <cstdio>

namespace command {
namespace {

double grams(double kilograms) { return 1e3 * kilograms; }

}  // namespace

void DripRecord::note(const SceneWorld& world) {
  const double before = m_mass;
  m_drops = 0;
  m_mass = m_pending = 0;
  for (const wetcloth::WetCloth* cloth : world.cloths()) {
    cloth->forEach<wetcloth::Dripping>([&](const wetcloth::Dripping& dripping) {
      m_isOn = true;
      m_drops += dripping.drops();
      m_mass += dripping.drippedMass();
      m_pending += dripping.pendingMass();
    });
  }
  const std::size_t tenths = m_massByTenth.size();
  m_massByTenth[static_cast<std::size_t>(m_noted) * tenths / static_cast<std::size_t>(m_steps)] += m_mass - before;
  ++m_noted;
}

nlohmann::ordered_json DripRecord::progress() const { return {{"mass_kg", m_mass}, {"kg_by_tenth", m_massByTenth}}; }

void DripRecord::goOnFrom(const nlohmann::ordered_json& progress, int stepsMade) {
  m_noted = stepsMade;
  m_mass = progress.at("mass_kg").get<double>();
  m_massByTenth = progress.at("kg_by_tenth").get<std::array<double, 10>>();
}

nlohmann::ordered_json DripRecord::json() const {
  return {{"count", m_drops}, {"mass_kg", m_mass}, {"pending_kg", m_pending}, {"kg_by_tenth", m_massByTenth}};
}

std::string DripRecord::line() const {
  if (!m_isOn) return "";
  char text[200];
  std::snprintf(
      text, sizeof text,
      "%-15s%lld drops of %.2f g in all, %.2f g no full drop yet; first tenth of the run %.2f g, last %.2f g\n",
      "drips", m_drops, grams(m_mass - m_pending), grams(m_pending), grams(m_massByTenth.front()),
      grams(m_massByTenth.back()));
  return text;
}

}  // namespace command
