// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/Rain.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <cstddef>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

void requireDirection(const btVector3& direction) {
  requireFinite("Rain.direction", direction);
  if (directionOf(direction).isZero()) reject("Rain.direction", "must not be of length 0");
}

// Finite as Bullet's scalar, too.
void requireSpeed(double speed) {
  requireNotNegative("Rain.speed", speed);
  requireFinite("Rain.speed", static_cast<double>(static_cast<btScalar>(speed)));
}

}  // namespace

Rain::Rain(Parameters parameters) : m_parameters(parameters) {
  requireDirection(m_parameters.direction);
  requireNotNegative("Rain.flux", m_parameters.flux);
  requireSpeed(m_parameters.speed);
}

void Rain::setDirection(const btVector3& direction) {
  requireDirection(direction);
  m_parameters.direction = direction;
}

void Rain::setFlux(double flux) {
  requireNotNegative("Rain.flux", flux);
  m_parameters.flux = flux;
}

void Rain::setSpeed(double speed) {
  requireSpeed(speed);
  m_parameters.speed = speed;
}

void Rain::attach(WetCloth& cloth) {
  m_catcher.attach("Rain", cloth.body());
  if (m_parameters.selfShelter) m_shelter.resize(m_catcher.positions().size(), m_catcher.triangles().size());
}

void Rain::apply(WetCloth& cloth, const Step& step) {
  if (m_parameters.flux == 0) {
    m_catcher.skip();
    return;
  }
  m_catcher.begin(cloth.body());
  const btVector3 direction = directionOf(m_parameters.direction);
  if (m_parameters.selfShelter) m_shelter.update(m_catcher.positions(), m_catcher.triangles(), direction);
  catchDrops(direction, step.dt);
  m_catcher.deliver(cloth.water(), std::numeric_limits<double>::infinity());
  m_nodesVisited += static_cast<long long>(m_catcher.positions().size());
}

bool Rain::wakes(const WetCloth& /*cloth*/, const Step& /*step*/) const { return caught() > 0; }

void Rain::catchDrops(const btVector3& direction, double dt) {
  const btVector3 velocity = direction * static_cast<btScalar>(m_parameters.speed);
  for (std::size_t f = 0; f < m_catcher.triangles().size(); ++f) {
    if (m_parameters.selfShelter && m_shelter.isSheltered(f)) continue;
    m_catcher.strike(f, direction, m_parameters.flux * dt, velocity);
  }
}

void Rain::transferState(StateArchive& archive) {
  m_catcher.transferState(archive);
  archive.value(m_nodesVisited);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
