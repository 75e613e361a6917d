// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/WetStiffness.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/effects/HookeSprings.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <cmath>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

void requireFactor(const std::string& field, double value) {
  if (!(value >= 0.001 && value <= 1000)) rejectValue(field, value, "in [0.001, 1000]");
}

void requireValid(const WetStiffness::Parameters& parameters) {
  requireFactor("WetStiffness.wetStretch", parameters.wetStretch);
  requireFactor("WetStiffness.wetBending", parameters.wetBending);
  requireNotNegative("WetStiffness.dryDamping", parameters.dryDamping);
  requireNotNegative("WetStiffness.wetDamping", parameters.wetDamping);
}

void giveBackLinks(WetCloth& cloth) {
  cloth.linkConstants().setStiffness({});
  cloth.linkConstants().refresh();
}

}  // namespace

double wetStiffnessFactor(double saturation, double atSaturation) { return 1 + (atSaturation - 1) * saturation; }

double dampingShare(double rate, double dt) { return -std::expm1(-rate * dt); }

btVector3 dampingImpulse(const btVector3& ab, const btVector3& velocity, btScalar inverseMasses, btScalar share) {
  const btScalar squared = ab.length2();
  if (!(squared > 0 && inverseMasses > 0)) return btVector3(0, 0, 0);
  return ab * (-share * velocity.dot(ab) / (squared * inverseMasses));
}

WetStiffness::WetStiffness(Parameters parameters) { setParameters(parameters); }

void WetStiffness::setParameters(Parameters parameters) {
  requireValid(parameters);
  if (m_cloth) requireScalable(*m_cloth, parameters);
  m_factors.resize(scales(parameters) ? m_saturation.size() : 0);
  if (m_cloth && scales() && !scales(parameters)) giveBackLinks(*m_cloth);
  m_parameters = parameters;
  m_factorsAreStale = true;
  m_sharesDt = 0;
}

void WetStiffness::requireScalable(const WetCloth& cloth, const Parameters& parameters) const {
  if (scales(parameters) && cloth.isInDeformableWorld() && !cloth.has("HookeSprings")) {
    reject("WetStiffness",
           "in the deformable world Bullet's springs have one stiffness for all links and read none per link; add "
           "HookeSprings first, or set wetStretch and wetBending to 1");
  }
}

void WetStiffness::attach(WetCloth& cloth) {
  const int links = cloth.body().m_links.size();
  if (links == 0) rejectValue("WetStiffness: body.m_links.size()", 0, "at least 1: stiffness is that of links");
  if (cloth.has(name(), this)) reject("WetStiffness", "the cloth has one already");
  requireScalable(cloth, m_parameters);
  m_cloth = &cloth;
  m_saturation.reset(cloth.body(), cloth.water());
  m_shares.resize(m_saturation.size());
  m_inverseMass.resize(cloth.water().size());
  cloth.packedNodes().fit();
  m_factors.resize(scales() ? m_saturation.size() : 0);
  m_sharesDt = 0;
  m_factorsAreStale = true;
}

void WetStiffness::detach(WetCloth& cloth) {
  if (scales()) giveBackLinks(cloth);
  m_cloth = nullptr;
}

void WetStiffness::apply(WetCloth& cloth, const Step& step) {
  if (!scales() && !damps()) return;
  const btSoftBody& body = cloth.body();
  const bool constantsWereReset = m_constantsWillBeReset && !body.m_bUpdateRtCst;
  m_constantsWillBeReset = body.m_bUpdateRtCst;
  const bool changed = m_saturation.update(cloth.water());
  if (scales() && (changed || m_factorsAreStale)) {
    scaleLinks(cloth);
  } else if (scales() && constantsWereReset) {
    cloth.linkConstants().refresh();
  }
  if (!damps()) return;
  if (changed || step.dt != m_sharesDt) updateShares(step.dt);
  if (body.isActive()) damp(cloth);
}

void WetStiffness::scaleLinks(WetCloth& cloth) {
  const btSoftBody& body = cloth.body();
  for (std::size_t k = 0; k < m_factors.size(); ++k) {
    const bool isBending = body.m_links[static_cast<int>(k)].m_bbending != 0;
    const double wet = isBending ? m_parameters.wetBending : m_parameters.wetStretch;
    m_factors[k] = static_cast<btScalar>(wetStiffnessFactor(m_saturation[k], wet));
  }
  m_linksVisited += static_cast<long long>(m_factors.size());
  m_factorsAreStale = false;
  cloth.linkConstants().setStiffness(m_factors);
  // The commit of this step, if there is one, writes the constants with the new masses.
  if (!cloth.water().movedSinceCommit()) cloth.linkConstants().refresh();
}

void WetStiffness::updateShares(double dt) {
  const double dry = m_parameters.dryDamping;
  const double wet = m_parameters.wetDamping;
  for (std::size_t k = 0; k < m_shares.size(); ++k) {
    m_shares[k] = static_cast<btScalar>(dampingShare(dry + (wet - dry) * m_saturation[k], dt));
  }
  m_sharesDt = dt;
}

// Water that moved in this step counts: the commit that follows writes it into the masses.
void WetStiffness::weigh(const WetCloth& cloth, const PackedNodes& nodes) {
  const Water& water = cloth.water();
  const bool massesAreStale = water.movedSinceCommit();
  for (std::size_t i = 0; i < m_inverseMass.size(); ++i) {
    const btScalar known = nodes.inverseMass[nodes.slot(i)];
    m_inverseMass[i] = massesAreStale && known > 0 ? static_cast<btScalar>(1 / water.totalMass(i)) : known;
  }
}

// One link after the other, each seeing what those before it left, so that no step is too large.
void WetStiffness::damp(WetCloth& cloth) {
  cloth.joinArrivals();
  PackedNodes& nodes = cloth.packedNodes();
  nodes.read();
  weigh(cloth, nodes);
  const auto between = [](const PackedNodes::Lane(&lanes)[3], std::size_t a, std::size_t b) {
    return btVector3(lanes[0][b] - lanes[0][a], lanes[1][b] - lanes[1][a], lanes[2][b] - lanes[2][a]);
  };
  for (std::size_t k = 0; k < m_shares.size(); ++k) {
    if (m_shares[k] == 0) continue;
    const LinkSaturation::Ends& ends = m_saturation.ends(k);
    const btScalar massA = m_inverseMass[ends.a];
    const btScalar massB = m_inverseMass[ends.b];
    const std::size_t a = nodes.slot(ends.a);
    const std::size_t b = nodes.slot(ends.b);
    const btVector3 impulse =
        dampingImpulse(between(nodes.position, a, b), between(nodes.velocity, a, b), massA + massB, m_shares[k]);
    const btScalar size = impulse.x() + impulse.y() + impulse.z();
    if (!(size - size == 0)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      nodes.velocity[axis][a] -= impulse[axis] * massA;
      nodes.velocity[axis][b] += impulse[axis] * massB;
    }
  }
  nodes.velocitiesChanged();
  m_linksVisited += static_cast<long long>(m_shares.size());
}

void WetStiffness::transferState(StateArchive& archive) {
  m_saturation.transferState(archive);
  archive.array(m_factors);
  archive.array(m_shares);
  archive.value(m_sharesDt, m_factorsAreStale, m_constantsWillBeReset, m_linksVisited);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
