// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/Cling.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/WetClothWorld.h"
#include "bullet_wetcloth/bullet/Contacts.h"
#include "bullet_wetcloth/bullet/ImpulseMatrix.h"
#include "bullet_wetcloth/bullet/ShapeReach.h"
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

// How far from a body's shape a node is still on it: Bullet has contacts within the margin.
btScalar reachOf(const WetCloth& cloth) {
  return btScalar(1.5) * cloth.body().getCollisionShape()->getMargin() + kContactMotionTolerance;
}

// How far a kinematic body has gone ahead of the node: it is at the end of its motion already.
btVector3 lead(const btCollisionObject& object, const btVector3& position, double dt) {
  const btRigidBody* rigid = btRigidBody::upcast(&object);
  if (!rigid || !object.isKinematicObject()) return {0, 0, 0};
  return rigid->getVelocityInLocalPoint(position - object.getWorldTransform().getOrigin()) * static_cast<btScalar>(dt);
}

// In the frame of a body; a kinematic one as it was when the node came there.
btVector3 placeOn(const btCollisionObject& object, const btVector3& position, double dt) {
  return object.getWorldTransform().invXform(position + lead(object, position, dt));
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
  if (object.isKinematicObject()) {
    way -= lead(object, position, dt);
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
  cloth.restMesh();
  m_bonds.resize(cloth.water().size());
  m_pull.resize(cloth.water().size());
  m_shear.resize(cloth.water().size());
}

void Cling::detach(WetCloth& cloth) {
  cloth.setLayerCling({}, {});
  m_bonds.assign(m_bonds.size(), Bond());
  m_bondCount = 0;
}

void Cling::apply(WetCloth& cloth, const Step& step) {
  if (cloth.isGuarded()) holdLayers(cloth);
  renew(cloth, step, knowsContacts(cloth, step));
  if (m_bondCount == 0) return;
  WorldObjects objects(cloth.world().world());
  for (std::size_t i = 0; i < m_bonds.size(); ++i) {
    Bond& bond = m_bonds[i];
    if (!bond.object) continue;
    ++m_nodesVisited;
    const bool isThere = objects.find(bond.object) && proxyNumberOf(*bond.object) == bond.proxy;
    const bool sticks = isThere && bond.object->hasContactResponse() && share(cloth.water().saturation(i)) > 0;
    const bool holds = sticks && (bond.isReported || isOn(cloth, step, i));
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
void Cling::renew(WetCloth& cloth, const Step& step, bool knowsContacts) {
  if (m_bondCount > 0) {
    for (Bond& bond : m_bonds) bond.isReported = false;
  }
  if (!knowsContacts) return;
  RigidContacts(cloth.body(), cloth.world().world(), cloth.isInDeformableWorld())
      .visit([&](const RigidContact& contact) { take(cloth, step, contact); });
}

// As it was a step ago: the shape, and the node's place but for what its velocity explains.
bool Cling::isSteady(const WetCloth& cloth, const Step& step, std::size_t i) const {
  const Bond& bond = m_bonds[i];
  const btSoftBody::Node& node = cloth.body().m_nodes[static_cast<int>(i)];
  const btScalar most = reachOf(cloth) + node.m_v.length() * static_cast<btScalar>(step.dt);
  const btVector3 way = placeOn(*bond.object, node.m_x, step.dt) - bond.seen;
  return hasShapeOf(bond) && way.length2() <= most * most;
}

// Asks the shape. Who was put elsewhere is held there, if at all.
bool Cling::isOn(const WetCloth& cloth, const Step& step, std::size_t i) {
  Bond& bond = m_bonds[i];
  if (!isSteady(cloth, step, i)) {
    bond.anchor = placeOn(*bond.object, cloth.body().m_nodes[static_cast<int>(i)].m_x, step.dt);
    bond.seen = bond.anchor;
    rememberShape(bond);
  }
  return isWithinReach(*bond.shape, bond.anchor, reachOf(cloth));
}

void Cling::take(WetCloth& cloth, const Step& step, const RigidContact& contact) {
  const int node = contact.point.nodes[0];
  const std::size_t i = static_cast<std::size_t>(node);
  if (contact.point.count != 1 || !(share(cloth.water().saturation(i)) > 0)) return;
  const btCollisionObject& object = *contact.object;
  if (!object.hasContactResponse() || object.getInternalType() == btCollisionObject::CO_FEATHERSTONE_LINK) return;
  if (cloth.body().m_nodes[node].m_im == 0) return;

  Bond& bond = m_bonds[i];
  const int proxy = proxyNumberOf(object);
  const bool isSame = bond.object == contact.object && bond.proxy == proxy;
  if (bond.object && !isSame) return;                      // held by the first of two
  if (bond.isReported && contact.gap >= bond.gap) return;  // the nearest of an object's parts tells the normal
  // Contacts are those of the last substep: what neither changed nor was put elsewhere since is as Bullet says.
  const btVector3 seen = placeOn(object, cloth.body().m_nodes[node].m_x, step.dt);
  if (!bond.object && !isWithinReach(*object.getCollisionShape(), seen, reachOf(cloth))) return;
  if (bond.object && !isSteady(cloth, step, i) && !isOn(cloth, step, i)) {
    release(bond);
    return;
  }
  const btTransform& frame = object.getWorldTransform();
  const btVector3 position = frame.invXform(cloth.body().m_nodes[node].m_x);
  bond.normal = contact.normal * frame.getBasis();
  bond.gap = contact.gap;
  bond.isReported = true;
  if (bond.object) {
    // How deep it is in the margin is Bullet's to decide.
    bond.anchor += bond.normal * bond.normal.dot(position - bond.anchor);
    return;
  }
  bond.object = contact.object;
  bond.proxy = proxy;
  rememberShape(bond);
  bond.anchor = position;
  bond.seen = seen;
  ++m_bondCount;
}

void Cling::hold(WetCloth& cloth, const Step& step, std::size_t i) {
  Bond& bond = m_bonds[i];
  btSoftBody::Node& node = cloth.body().m_nodes[static_cast<int>(i)];
  const btScalar dt = static_cast<btScalar>(step.dt);
  const double area = contactArea(cloth.restMesh(), cloth.water(), cloth.fabricOf(i).arealDensity, i);
  const double strength = share(cloth.water().saturation(i)) * area * step.dt;
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
  bond.seen = placeOn(*bond.object, node.m_x, step.dt);
  cloth.push(node, given.impulse * node.m_im);
  if (rigid) {
    rigid->activate();
    rigid->applyImpulse(-given.impulse, arm);
  }
}

// Vertices of both layers hold: half of the stress each.
void Cling::holdLayers(WetCloth& cloth) {
  bool isDry = true;
  for (std::size_t i = 0; i < m_pull.size(); ++i) {
    const double area = contactArea(cloth.restMesh(), cloth.water(), cloth.fabricOf(i).arealDensity, i);
    const double strength = share(cloth.water().saturation(i)) * area / 2;
    isDry = isDry && !(strength > 0);
    m_pull[i] = static_cast<btScalar>(m_parameters.adhesion * strength);
    m_shear[i] = static_cast<btScalar>(m_parameters.shearStrength * strength);
  }
  isDry ? cloth.setLayerCling({}, {}) : cloth.setLayerCling(m_pull, m_shear);
}

// The shape that it had may have been deleted: only addresses are compared.
bool Cling::hasShapeOf(const Bond& bond) {
  const btCollisionShape* const shape = bond.object->getCollisionShape();
  return shape == bond.shape && shape->getLocalScaling() == bond.scaling;
}

void Cling::rememberShape(Bond& bond) {
  bond.shape = bond.object->getCollisionShape();
  bond.scaling = bond.shape->getLocalScaling();
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
    if (!objects.find(bond.object) || proxyNumberOf(*bond.object) != bond.proxy || !hasShapeOf(bond)) return true;
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
  archive.value(bond.proxy, bond.scaling, bond.anchor, bond.seen, bond.normal, bond.isReported);
  if (archive.isRestoring() && holds && !bond.object) bond.object = &nowhere;
  if (archive.isRestoring() && bond.object) bond.shape = bond.object->getCollisionShape();
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
