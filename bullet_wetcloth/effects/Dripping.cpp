// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/Dripping.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/bullet/RequireFaces.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <cmath>
#include <limits>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

void requireValid(const Dripping::Parameters& parameters) {
  requireFraction("Dripping.holdingSaturation", parameters.holdingSaturation);
  requirePositive("Dripping.timeConstant", parameters.timeConstant);
  requireNotNegative("Dripping.dropMass", parameters.dropMass);
  requireFraction("Dripping.slopeTolerance", parameters.slopeTolerance);
  requireFraction("Dripping.squeeze", parameters.squeeze);
}

}  // namespace

double drippingStep(double held, double holding, double timeConstant, double dt) {
  return held > holding ? (held - holding) * -std::expm1(-dt / timeConstant) : 0;
}

bool isLower(const btVector3& other, const btVector3& x, const btVector3& down, double slopeTolerance) {
  const btVector3 towards = other - x;
  return static_cast<double>(towards.dot(down)) > slopeTolerance * static_cast<double>(towards.length());
}

Dripping::Dripping(Parameters parameters) { setParameters(std::move(parameters)); }

void Dripping::setParameters(Parameters parameters) {
  requireValid(parameters);
  m_parameters = std::move(parameters);
  m_nothingLeft.restart();
  m_steadyState.restart();
}

void Dripping::attach(WetCloth& cloth) {
  requireFaces("Dripping", cloth.body());
  m_mesh = &cloth.restMesh();
  const std::size_t nodes = cloth.water().size();
  m_carry.reset(nodes);
  // What dripped from nodes that are gone is some other node's to report.
  for (std::size_t i = nodes; i < m_pending.size(); ++i) m_pending[0] += m_pending[i];
  m_pending.resize(nodes, 0);
  m_spans.restart();
  m_nothingLeft.restart();
  m_steadyState.restart();
}

void Dripping::apply(WetCloth& cloth, const Step& step) {
  const btScalar gravity = step.gravity.length();
  if (!(gravity > 0 && std::isfinite(gravity))) return;
  Water& water = cloth.water();
  if (m_nothingLeft.holds(water)) return;
  if (m_steadyState.isReached(cloth.body(), cloth.water(), step.gravity)) return;

  if (m_parameters.squeeze > 0) m_spans.measure(*m_mesh, cloth.body());
  const btVector3 down = step.gravity / gravity;
  const double least = m_parameters.holdingSaturation * squeezedRoom(0, m_parameters.squeeze);
  bool hasExcess = false;
  bool drips = false;
  for (std::size_t i = 0; i < m_carry.size(); ++i) {
    if (!(water.held(i) > least * water.capacity(i))) continue;
    hasExcess = true;
    const double stays = holding(cloth, i, down);
    if (!(water.held(i) > stays)) continue;
    drips = true;
    cloth.joinArrivals(i);
    shed(water, i, stays, step.dt);
    report(cloth, step, i);
  }
  m_nodesVisited += static_cast<long long>(m_carry.size());
  m_nothingLeft.note(water, !hasExcess);
  // However slowly a node drips, it drips on: only when none does may the cloth's shape decide when to look again.
  m_steadyState.note(cloth.body(), cloth.water(), step.gravity, step.dt, drips ? water.totalCapacity() : 0);
}

double Dripping::pendingMass() const {
  CompensatedSum sum;
  for (const double pending : m_pending) sum.add(pending);
  return sum.value();
}

double Dripping::holding(const WetCloth& cloth, std::size_t node, const btVector3& down) const {
  const double squeeze = m_parameters.squeeze;
  const double room = squeeze > 0 ? squeezedRoom(m_spans.share(node), squeeze) : 1;
  const double atLowPoint = m_parameters.holdingSaturation * room * cloth.capacity(node);
  if (cloth.held(node) > atLowPoint && isLowPoint(cloth.body(), node, down)) return atLowPoint;
  return room < 1 ? room * cloth.capacity(node) : std::numeric_limits<double>::infinity();
}

bool Dripping::isLowPoint(const btSoftBody& body, std::size_t node, const btVector3& down) const {
  const btVector3& x = body.m_nodes[static_cast<int>(node)].m_x;
  for (const int neighbour : m_mesh->neighbours(node)) {
    if (isLower(body.m_nodes[neighbour].m_x, x, down, m_parameters.slopeTolerance)) return false;
  }
  return true;
}

void Dripping::shed(Water& water, std::size_t node, double holding, double dt) {
  const double held = water.held(node);
  const double exact = held - m_carry[node];
  const double leaving = drippingStep(exact, holding, m_parameters.timeConstant, dt);
  const bool isLast = exact - leaving - holding <= kNegligible * water.capacity(node);
  const auto drip = [&](double mass) { return water.drip(node, mass); };
  const double left = isLast ? drip(held - holding) : m_carry.pass(node, leaving, drip);
  if (isLast) m_carry.settle(node);
  m_pending[node] += left;
  m_dripped.add(left);
}

void Dripping::report(WetCloth& cloth, const Step& step, std::size_t node) {
  const double mass = m_pending[node];
  if (!(mass > 0 && mass >= m_parameters.dropMass)) return;
  m_pending[node] = 0;
  ++m_drops;
  if (!m_parameters.onDrip) return;
  const int number = static_cast<int>(node);
  const btSoftBody::Node& from = cloth.body().m_nodes[number];
  m_parameters.onDrip({step.time, from.m_x, from.m_v, mass, number, &cloth});
}

void Dripping::transferState(StateArchive& archive) {
  m_carry.transferState(archive);
  archive.array(m_pending);
  m_dripped.transferState(archive);
  m_steadyState.transferState(archive);
  m_nothingLeft.transferState(archive);
  archive.value(m_drops, m_nodesVisited);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
