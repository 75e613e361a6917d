// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/Immersion.h"

#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/effects/Absorption.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void requireValid(const Immersion::Parameters& parameters) {
  if (parameters.surface) requireValid("Immersion.surface", *parameters.surface);
}

// Bullet's own comparison looks at the fourth number, too, which means nothing.
bool isSame(const btVector3& a, const btVector3& b) { return a.x() == b.x() && a.y() == b.y() && a.z() == b.z(); }

bool isSame(const std::optional<WaterSurface>& a, const std::optional<WaterSurface>& b) {
  if (!a || !b) return !a && !b;
  return isSame(a->normal, b->normal) && a->offset == b->offset && isSame(a->velocity, b->velocity);
}

}  // namespace

double immersionShare(double depth, double dt, double timeConstant) {
  return depth > 0 ? exponentialShare(dt / timeConstant) : 0;
}

Immersion::Immersion(Parameters parameters) { setParameters(parameters); }

void Immersion::setParameters(Parameters parameters) {
  requireValid(parameters);
  m_parameters = parameters;  // apply() notices another surface
}

void Immersion::attach(WetCloth& cloth) {
  const bool firstTime = m_uptake.size() == 0;  // later, the application may have let the water out
  if (firstTime) requireSurface("Immersion.surface", m_parameters.surface, cloth.body());
  m_uptake.reset(cloth.water().size());
  m_shares.assign(cloth.fabrics().size(), 0);
  m_steadyState.restart();
  m_nothingLeft.restart();
}

void Immersion::apply(WetCloth& cloth, const Step& step) {
  noticeSurface(surfaceFor(m_parameters.surface, cloth.body()));
  if (m_surface && !isIdle(cloth, step)) soak(cloth, step);
}

void Immersion::noticeSurface(const std::optional<WaterSurface>& surface) {
  if (isSame(surface, m_surface)) return;
  m_surface = surface;
  m_steadyState.restart();
}

bool Immersion::isIdle(const WetCloth& cloth, const Step& step) {
  if (m_nothingLeft.holds(cloth.water())) return true;
  if (!m_steadyState.isReached(cloth.body(), cloth.water(), step.gravity)) return false;
  if (reach(cloth.body()) < m_reachLimit) return true;
  m_steadyState.restart();
  return false;
}

void Immersion::soak(WetCloth& cloth, const Step& step) {
  Water& water = cloth.water();
  bool isFull = true;
  bool isSoaking = false;
  bool isWet = false;
  double clearance = kInfinity;  // of the lowest node that is above and could take water [m]
  for (std::size_t k = 0; k < m_shares.size(); ++k) {
    m_shares[k] = immersionShare(kInfinity, step.dt, cloth.fabrics()[k].timeConstant);
  }
  for (std::size_t i = 0; i < m_uptake.size(); ++i) {
    const double room = m_uptake.room(water, i);
    if (!(room > 0)) continue;
    const double depth = m_surface->depth(cloth.body().m_nodes[static_cast<int>(i)].m_x);
    if (!(depth > 0)) {
      clearance = std::min(clearance, -depth);
      isFull = false;
      continue;
    }
    isWet = true;
    const bool filled = m_uptake.soak(water, i, room, m_shares[water.fabric(i)] * room, m_surface->velocity);
    isFull = isFull && filled;
    isSoaking = isSoaking || !filled;
  }
  m_nodesVisited += static_cast<long long>(m_uptake.size());
  m_nothingLeft.note(water, isFull);
  m_reachLimit = isWet ? kInfinity : reach(cloth.body()) + clearance / 4;
  // An exponential that has slowed down is not yet at its end: what counts is whether anything is left to soak.
  m_steadyState.note(cloth.body(), cloth.water(), step.gravity, step.dt, isSoaking ? water.totalCapacity() : 0);
}

// Depth of the lowest corner of the body's bounds. They are those of the positions that Bullet predicted for the last
// substep, or began it with (deformable world), and a margin: never quite the nodes', but they sink with them.
double Immersion::reach(const btSoftBody& body) const {
  const btVector3& normal = m_surface->normal;
  const auto lowest = [&](int axis) { return body.m_bounds[normal[axis] > 0 ? 0 : 1][axis]; };
  return m_surface->depth(btVector3(lowest(0), lowest(1), lowest(2)));
}

void Immersion::transferState(StateArchive& archive) {
  m_uptake.transferState(archive);
  m_steadyState.transferState(archive);
  archive.optional(m_surface, [&](WaterSurface& surface) { surface.transferState(archive); });
  m_nothingLeft.transferState(archive);
  archive.value(m_reachLimit, m_nodesVisited);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
