// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/Absorption.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

void requireValid(const Absorption::Parameters& parameters) {
  parameters.exposure.requireValid("Absorption.exposure");
  requirePositive("Absorption.rampDuration", parameters.rampDuration);
  requireFinite("Absorption.waterVelocity", parameters.waterVelocity);
}

}  // namespace

double exponentialShare(double rate) { return -std::expm1(-rate); }

double eulerShare(double rate) { return std::min(rate, 1.0); }

Absorption::Parameters Absorption::Parameters::paper() {
  Parameters parameters;
  parameters.law = Law::ramp;
  parameters.conservesMomentum = false;
  return parameters;
}

Absorption::Absorption(Parameters parameters) { setParameters(std::move(parameters)); }

void Absorption::setParameters(Parameters parameters) {
  requireValid(parameters);
  const bool isAttached = m_uptake.size() > 0;
  if (isAttached) parameters.exposure.requireSize("Absorption.exposure", m_uptake.size(), m_parameters.exposure);
  m_parameters = std::move(parameters);
  m_nothingLeft.restart();
}

void Absorption::attach(WetCloth& cloth) {
  const bool firstTime = m_uptake.size() == 0;
  if (firstTime) m_parameters.exposure.requireSize("Absorption.exposure", cloth.water().size());
  m_uptake.reset(cloth.water().size());
  m_uniformShares.assign(cloth.fabrics().size(), 0);
  m_nothingLeft.restart();
  m_hasNormals = false;
}

void Absorption::apply(WetCloth& cloth, const Step& step) {
  if (m_nothingLeft.holds(cloth.water())) return;
  const Exposure& exposure = m_parameters.exposure;
  if (exposure.isFunction() && !m_hasNormals) {
    // Bullet computes normals at the end of a step: a body that has never stepped has none yet.
    cloth.body().updateNormals();
    m_hasNormals = true;
  }
  const bool isUniform = !exposure.isFunction() && !exposure.isPerNode();
  for (std::size_t k = 0; isUniform && k < m_uniformShares.size(); ++k) {
    const double everywhere = exposure.at(0, btVector3(0, 0, 0), btVector3(0, 0, 0), step.middle());
    m_uniformShares[k] = share(everywhere, cloth.fabrics()[k].timeConstant, step);
  }
  bool settled = true;
  for (std::size_t i = 0; i < m_uptake.size(); ++i) {
    const btSoftBody::Node& node = cloth.body().m_nodes[static_cast<int>(i)];
    const double nodeShare =
        isUniform ? m_uniformShares[cloth.water().fabric(i)]
                  : share(exposure.at(i, node.m_x, node.m_n, step.middle()), cloth.fabricOf(i).timeConstant, step);
    const bool isFull = takeUp(cloth, i, nodeShare);
    // A function may expose the node later; anything else stays as it is.
    settled = settled && (isFull || (nodeShare == 0 && !exposure.isFunction()));
  }
  m_nodesVisited += static_cast<long long>(m_uptake.size());
  m_nothingLeft.note(cloth.water(), settled);
}

double Absorption::share(double exposure, double timeConstant, const Step& step) const {
  switch (m_parameters.law) {
    case Law::forwardEuler: return eulerShare(exposure * step.dt / timeConstant);
    case Law::ramp: return exposure * step.dt / m_parameters.rampDuration;
    case Law::exponential: break;
  }
  return exponentialShare(exposure * step.dt / timeConstant);
}

// Returns whether the node is full.
bool Absorption::takeUp(WetCloth& cloth, std::size_t node, double share) {
  Water& water = cloth.water();
  const double room = m_uptake.room(water, node);
  const double wanted = share * (m_parameters.law == Law::ramp ? water.capacity(node) : room);
  const btVector3& arriving =
      m_parameters.conservesMomentum ? m_parameters.waterVelocity : cloth.body().m_nodes[static_cast<int>(node)].m_v;
  return m_uptake.soak(water, node, room, wanted, arriving);
}

void Absorption::transferState(StateArchive& archive) {
  m_uptake.transferState(archive);
  m_nothingLeft.transferState(archive);
  archive.value(m_hasNormals, m_nodesVisited);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
