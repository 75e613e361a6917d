// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/Drying.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/bullet/RequireFaces.h"
#include "bullet_wetcloth/mesh/RestMesh.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kSecondsPerDay = 86400;
constexpr double kPenman = 6.43e3 / kSecondsPerDay;  // in still air [W/m^2/Pa]
constexpr double kWindFunction = 0.536;              // [s/m]
constexpr double kLatentHeat = 2.45e6;               // lambda [J/kg]

double windFunction(double airSpeed) { return 1 + kWindFunction * airSpeed; }

void requireValid(const Drying::Parameters& parameters) {
  if (!(parameters.temperature >= 0 && parameters.temperature <= 60)) {
    rejectValue("Drying.temperature", parameters.temperature, "in [0, 60]");
  }
  requireFraction("Drying.relativeHumidity", parameters.relativeHumidity);
  parameters.air.requireValid("Drying.air");
  if (!(parameters.criticalSaturation > 0 && parameters.criticalSaturation <= 1)) {
    rejectValue("Drying.criticalSaturation", parameters.criticalSaturation, "in (0, 1]");
  }
  if (!(parameters.equilibriumSaturation >= 0 && parameters.equilibriumSaturation < parameters.criticalSaturation)) {
    rejectValue("Drying.equilibriumSaturation", parameters.equilibriumSaturation, "in [0, criticalSaturation)");
  }
  if (!(parameters.sides > 0 && parameters.sides <= 2)) rejectValue("Drying.sides", parameters.sides, "in (0, 2]");
  if (!(parameters.selfCooling > 0 && parameters.selfCooling <= 1)) {
    rejectValue("Drying.selfCooling", parameters.selfCooling, "in (0, 1]");
  }
  parameters.exposure.requireValid("Drying.exposure");
}

double stillAirRate(const Drying::Parameters& parameters) {
  return parameters.sides * parameters.selfCooling *
         evaporationRate(parameters.temperature, parameters.relativeHumidity, 0);
}

}  // namespace

double saturationVapourPressure(double temperature) {
  return 610.8 * std::exp(17.27 * temperature / (temperature + 237.3));
}

double evaporationRate(double temperature, double relativeHumidity, double airSpeed) {
  const double deficit = saturationVapourPressure(temperature) * (1 - relativeHumidity);
  return kPenman * windFunction(airSpeed) * deficit / kLatentHeat;
}

double dryingStep(double held, double critical, double rate, double dt) {
  const double supply = rate * dt;
  const double aboveCritical = std::max(held - critical, 0.0);
  if (supply <= aboveCritical) return supply;
  return aboveCritical + (held - aboveCritical) * -std::expm1(-(supply - aboveCritical) / critical);
}

double dryingTime(double from, double to, double critical, double rate) {
  if (!(to < from)) return 0;
  if (!(to > 0 && rate > 0)) return std::numeric_limits<double>::infinity();
  const double constant = std::max(from - std::max(to, critical), 0.0);
  const double falling = to < critical ? critical * std::log(std::min(from, critical) / to) : 0;
  return (constant + falling) / rate;
}

Drying::Drying(Parameters parameters) { setParameters(std::move(parameters)); }

void Drying::setParameters(Parameters parameters) {
  requireValid(parameters);
  const bool isAttached = m_carry.size() > 0;
  if (isAttached) parameters.exposure.requireSize("Drying.exposure", m_carry.size(), m_parameters.exposure);
  m_parameters = std::move(parameters);
  m_stillAirRate = stillAirRate(m_parameters);
  m_nothingLeft.restart();
}

void Drying::attach(WetCloth& cloth) {
  requireFaces("Drying", cloth.body());
  const bool firstTime = m_carry.size() == 0;
  if (firstTime) m_parameters.exposure.requireSize("Drying.exposure", cloth.water().size());
  m_mesh = &cloth.restMesh();
  m_carry.reset(cloth.water().size());
  m_nothingLeft.restart();
  m_hasNormals = false;
}

void Drying::apply(WetCloth& cloth, const Step& step) {
  if (m_stillAirRate == 0 || m_nothingLeft.holds(cloth.water())) return;
  if (m_parameters.exposure.isFunction() && !m_hasNormals) {
    // Bullet computes normals at the end of a step: a body that has never stepped has none yet.
    cloth.body().updateNormals();
    m_hasNormals = true;
  }
  bool isDry = true;
  for (std::size_t i = 0; i < m_carry.size(); ++i) {
    const bool isNodeDry = dry(cloth, step, i);
    isDry = isDry && isNodeDry;
  }
  m_nodesVisited += static_cast<long long>(m_carry.size());
  m_nothingLeft.note(cloth.water(), isDry);
}

double Drying::rateOf(const WetCloth& cloth, const Step& step, std::size_t node) const {
  const btSoftBody::Node& at = cloth.body().m_nodes[static_cast<int>(node)];
  const double area = m_mesh->nodeAreas()[node] * m_parameters.exposure.at(node, at.m_x, at.m_n, step.middle());
  if (!(area > 0)) return 0;
  const btVector3 relative = m_parameters.air.at(at.m_x, step.middle()) - at.m_v;
  const double rate = m_stillAirRate * windFunction(static_cast<double>(relative.length())) * area;
  return std::isfinite(rate) ? rate : 0;
}

// For good.
bool Drying::isCovered(std::size_t node) const {
  const btVector3 anywhere(0, 0, 0);
  return !m_parameters.exposure.isFunction() && m_parameters.exposure.at(node, anywhere, anywhere, 0) == 0;
}

// Returns whether nothing more will dry off the node.
bool Drying::dry(WetCloth& cloth, const Step& step, std::size_t node) {
  Water& water = cloth.water();
  const double held = water.held(node);
  const double kept = m_parameters.equilibriumSaturation * water.capacity(node);
  if (!(held > kept)) return true;
  const double rate = rateOf(cloth, step, node);
  // A function may expose the node later, and a speed that is not finite pass; anything else stays as it is.
  if (!(rate > 0)) return m_mesh->nodeAreas()[node] == 0 || isCovered(node);

  const double exact = held - m_carry[node] - kept;
  const double critical = m_parameters.criticalSaturation * water.capacity(node) - kept;
  const double leaving = dryingStep(std::max(exact, 0.0), critical, rate, step.dt);
  const bool isLast = exact - leaving <= kNegligible * water.capacity(node);
  const auto evaporate = [&](double mass) { return water.evaporate(node, mass); };
  if (!isLast) {
    m_carry.pass(node, leaving, evaporate);
    return false;
  }
  evaporate(held - kept);
  m_carry.settle(node);
  return true;
}

void Drying::transferState(StateArchive& archive) {
  m_carry.transferState(archive);
  m_nothingLeft.transferState(archive);
  archive.value(m_hasNormals, m_nodesVisited);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
