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

void requireValid(const Rain::Parameters& parameters) {
  requireFinite("Rain.direction", parameters.direction);
  if (directionOf(parameters.direction).isZero()) reject("Rain.direction", "must not be of length 0");
  requireNotNegative("Rain.flux", parameters.flux);
  requireNotNegative("Rain.speed", parameters.speed);
  requireFiniteScalar("Rain.speed", parameters.speed);
}

}  // namespace

Rain::Rain(Parameters parameters) { setParameters(parameters); }

void Rain::setParameters(Parameters parameters) {
  requireValid(parameters);
  if (parameters.selfShelter) m_shelter.resize(m_catcher.positions().size(), m_catcher.triangles().size());
  m_parameters = parameters;
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
