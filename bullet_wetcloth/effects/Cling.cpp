// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/Cling.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/WetClothWorld.h"
#include "bullet_wetcloth/bullet/Contacts.h"
#include "bullet_wetcloth/bullet/ImpulseMatrix.h"
#include "bullet_wetcloth/numerics/ContactArea.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Share of a node's distance from its place that is made good in a step.
constexpr btScalar kRestoring = btScalar(0.5);
// Of a limit, so that rounding does not lift what was brought down to it.
constexpr double kNearly = 0.999;

void requireValid(const Cling::Parameters& parameters) {
  requireNotNegative("Cling.adhesion", parameters.adhesion);
  requireNotNegative("Cling.shearStrength", parameters.shearStrength);
  if (!(parameters.minimumSaturation >= 0 && parameters.minimumSaturation < 1)) {
    rejectValue("Cling.minimumSaturation", parameters.minimumSaturation, "in [0, 1)");
  }
  if (!(parameters.peakSaturation > parameters.minimumSaturation && parameters.peakSaturation <= 1)) {
    rejectValue("Cling.peakSaturation", parameters.peakSaturation, "in (minimumSaturation, 1]");
  }
  requireFraction("Cling.floodedShare", parameters.floodedShare);
}

int proxyNumberOf(const btCollisionObject& object) {
  const btBroadphaseProxy* proxy = object.getBroadphaseHandle();
  return proxy ? proxy->m_uniqueId : -1;
}

// A rigid body that an impulse moves, or null.
btRigidBody* movable(btCollisionObject& object) {
  return object.isStaticOrKinematicObject() ? nullptr : btRigidBody::upcast(&object);
}

// Velocity that the surface will have when Bullet has added gravity, with a share of the way back to the place.
btVector3 targetVelocity(const btCollisionObject& object, const btVector3& place, const btVector3& position,
                         btScalar dt) {
  btVector3 way = place - position;
  const btRigidBody* rigid = btRigidBody::upcast(&object);
  if (!rigid || object.isStaticObject()) return way * (kRestoring / dt);
  btVector3 velocity = rigid->getVelocityInLocalPoint(position - object.getWorldTransform().getOrigin());
  // A kinematic body is at the end of its motion already.
  if (object.isKinematicObject()) {
    way -= velocity * dt;
  } else if (object.isActive()) {
    velocity += rigid->getGravity() * rigid->getLinearFactor() * dt;
  }
  return velocity + way * (kRestoring / dt);
}

}  // namespace

BondImpulse bondImpulse(const btVector3& needed, const btVector3& normal, double pull, double shear) {
  BondImpulse bond;
  const btScalar away = needed.dot(normal);
  bond.breaks = !std::isfinite(away) || -static_cast<double>(away) > pull;
  if (bond.breaks) return bond;
  btVector3 along = needed - normal * away;
  const double length = static_cast<double>(along.length());
  bond.slides = length > shear;
  if (bond.slides) along *= static_cast<btScalar>(shear / length);
  bond.impulse = along + normal * std::min(away, btScalar(0));
  return bond;
}

Cling::Cling(Parameters parameters) { setParameters(parameters); }

void Cling::setParameters(Parameters parameters) {
  requireValid(parameters);
  m_parameters = parameters;
  const double range = 1 - parameters.minimumSaturation;
  m_curve = {0, 1, parameters.floodedShare, (parameters.peakSaturation - parameters.minimumSaturation) / range};
}

double Cling::share(double saturation) const {
  return m_curve.at((saturation - m_parameters.minimumSaturation) / (1 - m_parameters.minimumSaturation));
}

void Cling::attach(WetCloth& cloth) {
  const std::string why = whyNoNodeContacts(cloth.body(), cloth.isInDeformableWorld());
  if (!why.empty()) reject("Cling", why);
  m_areas.resize(cloth.water().size());
  for (std::size_t i = 0; i < m_areas.size(); ++i)
    m_areas[i] = contactArea(cloth.restMesh(), cloth.water(), cloth.fabric().arealDensity, i);
  m_bonds.resize(m_areas.size());
}

void Cling::detach(WetCloth&) {
  m_bonds.assign(m_bonds.size(), Bond());
  m_bondCount = 0;
}

void Cling::apply(WetCloth& cloth, const Step& step) {
  renew(cloth, knowsContacts(cloth, step));
  if (m_bondCount == 0) return;
  WorldObjects objects(cloth.world().world());
  for (std::size_t i = 0; i < m_bonds.size(); ++i) {
    Bond& bond = m_bonds[i];
    if (!bond.object) continue;
    ++m_nodesVisited;
    const bool isThere = objects.find(bond.object) && proxyNumberOf(*bond.object) == bond.proxy;
    const bool holds = isThere && bond.object->hasContactResponse() && share(cloth.water().saturation(i)) > 0;
    if (holds && cloth.body().m_nodes[static_cast<int>(i)].m_im > 0) {
      hold(cloth, step, i);
    } else {
      release(bond);
    }
  }
}

// The lists of a body that sleeps are those of the day when it fell asleep. Only the deformable world lets it sleep.
bool Cling::knowsContacts(const WetCloth& cloth, const Step& step) {
  const bool slept = m_nextTime >= 0 && std::fabs(step.time - m_nextTime) > 0.5 * step.dt;
  m_nextTime = step.time + step.dt;
  return !slept || !cloth.isInDeformableWorld();
}

// Bullet's contacts of the last substep make bonds, and tell which of them are still pressed to the surface.
void Cling::renew(WetCloth& cloth, bool knowsContacts) {
  if (m_bondCount > 0) {
    for (Bond& bond : m_bonds) bond.isReported = false;
  }
  if (!knowsContacts) return;
  RigidContacts(cloth.body(), cloth.world().world(), cloth.isInDeformableWorld())
      .visit([&](const RigidContact& contact) { take(cloth, contact); });
}

void Cling::take(WetCloth& cloth, const RigidContact& contact) {
  const int node = contact.point.nodes[0];
  const std::size_t i = static_cast<std::size_t>(node);
  if (contact.point.count != 1 || !(share(cloth.water().saturation(i)) > 0)) return;
  const btCollisionObject& object = *contact.object;
  if (!object.hasContactResponse() || object.getInternalType() == btCollisionObject::CO_FEATHERSTONE_LINK) return;
  if (cloth.body().m_nodes[node].m_im == 0) return;

  Bond& bond = m_bonds[i];
  const int proxy = proxyNumberOf(object);
  const bool isSame = bond.object == contact.object && bond.proxy == proxy;
  if (bond.object && !isSame) return;  // held by the first of two
  const btTransform& frame = object.getWorldTransform();
  const btVector3 position = frame.invXform(cloth.body().m_nodes[node].m_x);
  bond.normal = contact.normal * frame.getBasis();
  bond.isReported = true;
  if (bond.object) {
    // How deep it is in the margin is Bullet's to decide.
    bond.anchor += bond.normal * bond.normal.dot(position - bond.anchor);
    return;
  }
  bond.object = contact.object;
  bond.proxy = proxy;
  bond.anchor = position;
  ++m_bondCount;
}

void Cling::hold(WetCloth& cloth, const Step& step, std::size_t i) {
  Bond& bond = m_bonds[i];
  btSoftBody::Node& node = cloth.body().m_nodes[static_cast<int>(i)];
  const btScalar dt = static_cast<btScalar>(step.dt);
  const double strength = share(cloth.water().saturation(i)) * m_areas[i] * step.dt;
  const double pull = m_parameters.adhesion * strength;
  const btTransform& frame = bond.object->getWorldTransform();
  const btVector3 place = frame * bond.anchor;
  const btVector3 normal = frame.getBasis() * bond.normal;
  btRigidBody* const rigid = movable(*bond.object);
  const btVector3 arm = node.m_x - frame.getOrigin();
  const auto impulseFor = [&](const btVector3& change) {
    return rigid ? impulseMatrix(node.m_im, *rigid, arm) * change : change / node.m_im;
  };
  btVector3 needed = impulseFor(targetVelocity(*bond.object, place, node.m_x, dt) - (node.m_v + step.gravity * dt));
  if (bond.isReported) {
    const btVector3 fall =
        rigid && rigid->isActive() ? rigid->getGravity() * rigid->getLinearFactor() : btVector3(0, 0, 0);
    const btScalar weight = normal.dot(impulseFor((step.gravity - fall) * dt));
    const btScalar excess = -normal.dot(needed) - static_cast<btScalar>(kNearly * pull);
    if (static_cast<double>(weight) <= pull && excess > 0) needed += normal * excess;
  }
  const BondImpulse given = bondImpulse(needed, normal, pull, m_parameters.shearStrength * strength);
  if (given.breaks) {
    release(bond);
    return;
  }
  if (given.slides) {
    const btVector3 way = frame.invXform(node.m_x) - bond.anchor;
    bond.anchor += way - bond.normal * bond.normal.dot(way);
  }
  cloth.push(node, given.impulse * node.m_im);
  if (rigid) {
    rigid->activate();
    rigid->applyImpulse(-given.impulse, arm);
  }
}

void Cling::release(Bond& bond) {
  bond = Bond();
  --m_bondCount;
}

bool Cling::wakes(const WetCloth& cloth, const Step&) const {
  if (m_bondCount == 0) return false;
  WorldObjects objects(cloth.world().world());
  for (std::size_t i = 0; i < m_bonds.size(); ++i) {
    const Bond& bond = m_bonds[i];
    if (!bond.object) continue;
    if (!objects.find(bond.object) || proxyNumberOf(*bond.object) != bond.proxy) return true;
    const btVector3 place = bond.object->getWorldTransform() * bond.anchor;
    if ((place - cloth.body().m_nodes[static_cast<int>(i)].m_x).length2() >
        kContactMotionTolerance * kContactMotionTolerance)
      return true;
  }
  return false;
}

void Cling::transferState(StateArchive& archive) {
  archive.each(m_bonds, [&](Bond& bond) { transferBond(archive, bond); });
  archive.value(m_nextTime, m_nodesVisited);
  if (!archive.isRestoring()) return;
  const auto holds = [](const Bond& bond) { return bond.object != nullptr; };
  m_bondCount = static_cast<int>(std::count_if(m_bonds.begin(), m_bonds.end(), holds));
}

// A bond with what has left the world since is saved as one with something that was never there: the next step ends it.
void Cling::transferBond(StateArchive& archive, Bond& bond) {
  static btCollisionObject nowhere;
  bool holds = bond.object != nullptr;
  archive.value(holds);
  archive.object(bond.object);
  archive.value(bond.proxy, bond.anchor, bond.normal, bond.isReported);
  if (archive.isRestoring() && holds && !bond.object) bond.object = &nowhere;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
