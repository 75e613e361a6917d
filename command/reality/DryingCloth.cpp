// SPDX-License-Identifier: Zlib
#include "command/reality/DryingCloth.h"

#include "command/fit/DryingAir.h"

#include <cmath>

namespace reality {
namespace {

accuracy::Specimen::Settings settingsOf(const DryingCloth::Settings& settings) {
  accuracy::Specimen::Settings flat;
  flat.patch = accuracy::levelSquare(std::sqrt(settings.area), 2, settings.fabric.arealDensity);
  flat.patch.pinnedEdges = {wetcloth::ClothPatch::Edge::bottom, wetcloth::ClothPatch::Edge::top};
  flat.fabric = settings.fabric;
  return flat;
}

}  // namespace

DryingCloth::DryingCloth(const Settings& settings) : m_specimen(settingsOf(settings)) {
  wetcloth::Drying::Parameters air = fit::airThatDries(settings.rate);
  air.criticalSaturation = settings.criticalSaturation;
  m_specimen.cloth().add<wetcloth::Drying>(air);
  const double capacity = settings.area * settings.fabric.arealDensity * settings.fabric.capacity;
  m_specimen.cloth().setSaturation(settings.water / capacity);
}

void DryingCloth::advance(double dt) {
  m_specimen.substep(dt);
  m_time += dt;
}

double DryingCloth::water() { return m_specimen.cloth().ledger().held; }

}  // namespace reality
