// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/drops/DropsStep.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetClothWorld.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kLeastShare = 0.01;  // of a full drop: less does not fly on by itself

bool areFinite(const Double3& v) { return std::isfinite(v[0] + v[1] + v[2]); }

Double3 between(const Double3& a, const Double3& b, double time) {
  return {a[0] + (b[0] - a[0]) * time, a[1] + (b[1] - a[1]) * time, a[2] + (b[2] - a[2]) * time};
}

}  // namespace

Drops::Flight::Flight(State& state, WetClothWorld& world, double flown, double time)
    : m_state(state), m_world(world), m_flown(flown), m_time(time), m_gravity(world.world().getGravity()) {
  if (!wetcloth::isFinite(m_gravity)) m_gravity.setZero();
}

void Drops::Flight::run() {
  const auto hasShed = [](const auto& followed) { return followed->target.cloth().water().hasShedMore(); };
  const bool isIdle = m_state.drops.size() == 0 && !m_state.spouts.mayPour(m_time - m_flown, m_time) &&
                      std::none_of(m_state.cloths.begin(), m_state.cloths.end(), hasShed);
  if (isIdle) {
    m_state.areFollowed = false;
    return;
  }
  look();
  if (m_flown > 0) flyAll();
  for (const auto& followed : m_state.cloths) shedFrom(*followed);
  if (m_flown > 0) pour();
  m_state.areFollowed = m_state.drops.size() > 0;
}

void Drops::Flight::look() {
  for (const auto& followed : m_state.cloths) {
    m_state.areFollowed ? followed->target.advance() : followed->target.restart();
  }
  m_state.areFollowed ? m_state.bodies.advance(m_world.world()) : m_state.bodies.restart(m_world.world());
  forgetGoneBodies();
}

void Drops::Flight::forgetGoneBodies() {
  const btCollisionObjectArray& objects = m_world.world().getCollisionObjectArray();
  for (const btCollisionObject* body : m_state.films.bodies()) {
    if (!body) continue;
    bool isThere = false;
    for (int i = 0; i < objects.size() && !isThere; ++i) isThere = objects[i] == body;
    if (!isThere) m_state.accounts.left.add(m_state.films.forget(*body));
  }
}

void Drops::Flight::flyAll() {
  std::size_t i = 0;
  while (i < m_state.drops.size()) {
    if (fly(i)) {
      ++i;
    } else {
      m_state.drops.remove(i);
    }
  }
}

// Returns whether it flies on.
bool Drops::Flight::fly(std::size_t i) {
  DropList& drops = m_state.drops;
  const Double3 before = drops.velocity(i);
  Double3 after;
  const DropPath path = pathOf(drops.position(i), before, drops.diameter(i), m_flown, after);
  const bool isLost = !areFinite(path.to) || !areFinite(after) || drops.age(i) >= m_state.parameters.longestFlight;
  const Hit hit = isLost ? Hit() : firstHit(path);
  if (!isLost && hit.isNone()) {
    drops.move(i, path.to, after, m_flown);
    return true;
  }
  const Rest rest = isLost ? land(hit, {path.from, path.from}, before, drops.mass(i))
                           : land(hit, path, between(before, after, hit.time), drops.mass(i));
  if (!(rest.mass > 0)) return false;
  drops.move(i, rest.position, rest.velocity, m_flown);
  drops.setMass(i, rest.mass);
  return true;
}

Double3 Drops::Flight::windAt(const Double3& place, double time) {
  WindField& wind = m_state.parameters.wind;
  if (!wind.isFunction()) return asDouble(wind.constant());
  try {
    return asDouble(wind.at(asBullet(place), time));
  } catch (...) {
    wind = WindField();
    m_world.log("wetcloth: Drops::Parameters::wind is 0 from now on, it threw: " + currentMessage());
    return {};
  }
}

DropPath Drops::Flight::pathOf(const Double3& from, const Double3& velocity, double diameter, double dt,
                               Double3& velocityAfter) {
  const Parameters& parameters = m_state.parameters;
  const Double3 wind = windAt(from, m_time - dt / 2);
  double squared = 0;
  for (std::size_t k = 0; k < 3; ++k) squared += (velocity[k] - wind[k]) * (velocity[k] - wind[k]);
  const DropMove move(dropDecay(diameter, std::sqrt(squared), parameters.air), dt);
  const Double3 gravity = asDouble(m_gravity);
  DropPath path{from, from};
  for (std::size_t k = 0; k < 3; ++k) {
    path.to[k] += move.way(velocity[k], wind[k], gravity[k]);
    velocityAfter[k] = move.velocity(velocity[k], wind[k], gravity[k]);
  }
  return path;
}

// Of a drop that falls from a node of `from`, now, or flies in the substep.
Drops::Flight::Hit Drops::Flight::firstHit(const DropPath& path, const State::Followed* from, int node) {
  Hit hit;
  for (const auto& followed : m_state.cloths) {
    if (!followed->target.isThere()) continue;
    const ClothTarget::Hit found = followed->target.firstHit(path, from, followed.get() == from ? node : -1);
    if (!(found.time < hit.time)) continue;
    hit.time = found.time;
    hit.cloth = followed.get();
    hit.face = found;
  }
  const BodyTargets::Hit body = m_state.bodies.firstHit(path);
  if (body.time < hit.time) {
    hit = Hit();
    hit.time = body.time;
    hit.body = body;
  }
  meetSurface(path, hit);
  return hit;
}

void Drops::Flight::meetSurface(const DropPath& path, Hit& hit) const {
  if (!m_state.surface) return;
  const Double3 normal = asDouble(m_state.surface->normal);
  double before = m_state.surface->offset;
  double after = before;
  for (std::size_t k = 0; k < 3; ++k) {
    before += normal[k] * path.from[k];
    after += normal[k] * path.to[k];
  }
  if (!(after < 0)) return;
  const double time = before > 0 ? before / (before - after) : 0;
  if (!(time < hit.time)) return;
  hit = Hit();
  hit.time = time;
}

Drops::Flight::Rest Drops::Flight::land(const Hit& hit, const DropPath& path, const Double3& velocity, double mass) {
  Rest rest;
  const bool isOnCloth = hit.cloth != nullptr;
  const Double3 place = hit.body.body ? hit.body.place : path.at(std::min(hit.time, 1.0));
  double kept = 0;
  if (isOnCloth) {
    kept = landOnCloth(hit, path, velocity, mass, rest);
    ++m_state.counts.landedOnCloth;
  } else {
    kept = hit.body.body ? landOnBody(hit.body, velocity, mass, rest) : 0;
    m_state.accounts.left.add(mass - kept - rest.mass);
    ++m_state.counts.ended;
  }
  WetCloth* const cloth = isOnCloth ? &hit.cloth->target.cloth() : nullptr;
  tell({m_time, asBullet(place), asBullet(velocity), mass, kept, cloth, hit.body.body});
  return rest;
}

double Drops::Flight::landOnCloth(const Hit& hit, const DropPath& path, const Double3& velocity, double mass,
                                  Rest& rest) {
  ClothTarget& target = hit.cloth->target;
  const ClothTarget::Side side = target.sideOf(hit.face, path);
  const double tooMuch = target.tooMuch(hit.face, mass);
  // What is hardly a drop, or has another layer of cloth before it, stays at the nodes until it is one.
  const bool goesOn = tooMuch > kLeastShare * m_state.parameters.dropMass && side.normal != Double3{0, 0, 0} &&
                      firstHit({side.onFace, side.place}, hit.cloth, hit.face.nodes[0]).isNone();
  Double3 after = runsOn(velocity, target.velocityAt(hit.face), side.normal);
  const double kept = target.land(hit.face, mass, velocity, goesOn ? &after : nullptr);
  m_state.accounts.taken.add(kept);
  m_state.accounts.returned.add(mass - kept);
  if (goesOn) rest = {mass - kept, side.place, after};
  return kept;
}

double Drops::Flight::landOnBody(const BodyTargets::Hit& hit, const Double3& velocity, double mass, Rest& rest) {
  constexpr double off = 1e-4;  // [m]
  btCollisionObject& object = const_cast<btCollisionObject&>(*hit.body);
  const double kept = m_state.films.add(object, asBullet(hit.place), mass);
  btRigidBody* const rigid = btRigidBody::upcast(&object);
  const btVector3 arm = rigid ? asBullet(hit.place) - rigid->getCenterOfMassPosition() : btVector3(0, 0, 0);
  const btVector3 ground = rigid ? rigid->getVelocityInLocalPoint(arm) : btVector3(0, 0, 0);
  btVector3 impulse = (asBullet(velocity) - ground) * static_cast<btScalar>(kept);
  if (mass - kept > kLeastShare * m_state.parameters.dropMass && hit.normal != Double3{0, 0, 0}) {
    rest.mass = mass - kept;
    rest.velocity = runsOn(velocity, asDouble(ground), hit.normal);
    for (std::size_t k = 0; k < 3; ++k) rest.position[k] = hit.place[k] + off * hit.normal[k];
    impulse += (asBullet(velocity) - asBullet(rest.velocity)) * static_cast<btScalar>(rest.mass);
  }
  if (rigid && !rigid->isStaticOrKinematicObject()) {
    rigid->activate();
    rigid->applyImpulse(impulse, arm);
  }
  return kept;
}

void Drops::Flight::flyOn(const Rest& rest) {
  if (rest.mass > 0) m_state.drops.add(rest.position, rest.velocity, rest.mass);
}

// A drop that finds no room on the ground where it lands hops on along it: it loses most of what went into the ground,
// and runs on at the speed of a thin film at least, in a direction of its own if it has none. The library's own model,
// with no measurement behind it.
Double3 Drops::Flight::runsOn(const Double3& velocity, const Double3& ground, const Double3& normal) const {
  constexpr double hop = 0.2;                   // of the speed into the ground
  constexpr double lowest = 0.1;                // off the ground [m/s]: it hops half a millimetre high
  constexpr double slide = 0.8;                 // of the speed along it
  constexpr double spread = 0.3;                // of the speed into the ground, along it
  constexpr double slowest = 0.3;               // [m/s]
  constexpr double golden = 2.399963229728653;  // [rad]
  const btVector3 out = asBullet(normal);
  const btVector3 relative = asBullet(velocity) - asBullet(ground);
  const btScalar into = btMax(btScalar(0), -relative.dot(out));
  btVector3 along = (relative + out * into) * btScalar(slide);
  btVector3 one, other;
  btPlaneSpace1(out, one, other);
  const double angle = golden * static_cast<double>(m_state.counts.landedOnCloth + m_state.counts.ended);
  const btVector3 aside = one * static_cast<btScalar>(std::cos(angle)) + other * static_cast<btScalar>(std::sin(angle));
  along += aside * (btScalar(spread) * into);
  const btScalar speed = along.length();
  if (speed < btScalar(slowest)) along = (speed > btScalar(1e-3) ? along / speed : aside) * btScalar(slowest);
  return asDouble(asBullet(ground) + along + out * btMax(btScalar(hop) * into, btScalar(lowest)));
}

void Drops::Flight::tell(const Landing& landing) {
  if (!m_state.parameters.onLanding) return;
  try {
    m_state.parameters.onLanding(landing);
  } catch (...) {
    m_state.parameters.onLanding = nullptr;
    m_world.log("wetcloth: Drops::Parameters::onLanding is not asked any more, it threw: " + currentMessage());
  }
}

// A drop falls from the node, through what is between it and where it hangs.
void Drops::Flight::shedFrom(State::Followed& followed) {
  WetCloth& cloth = followed.target.cloth();
  Water& water = cloth.water();
  if (!water.hasShedMore() || !followed.target.isThere()) return;
  water.clearShedMore();
  const btScalar gravity = m_gravity.length();
  const btVector3 down = gravity > 0 ? m_gravity / gravity : btVector3(0, 0, 0);
  const double least = m_state.parameters.dropMass;
  for (std::size_t n = 0; n < water.size(); ++n) {
    const double mass = water.shed(n);
    if (!(mass >= least)) continue;
    const int node = static_cast<int>(n);
    const btSoftBody::Node& from = cloth.body().m_nodes[node];
    if (!wetcloth::isFinite(from.m_x) || !wetcloth::isFinite(from.m_v)) continue;
    water.takeShed(n);
    ++m_state.counts.born;
    const double radius = dropDiameter(mass, m_state.parameters.air.waterDensity) / 2;
    const DropPath path{asDouble(from.m_x), asDouble(from.m_x + down * static_cast<btScalar>(radius))};
    const Hit hit = firstHit(path, &followed, node);
    if (hit.isNone()) {
      m_state.drops.add(path.to, asDouble(from.m_v), mass);
    } else {
      flyOn(land(hit, path, asDouble(from.m_v), mass));
    }
  }
}

void Drops::Flight::pour() {
  const Spouts::Substep substep{m_time, m_flown, m_gravity, m_state.parameters.air.waterDensity};
  const std::string failure =
      m_state.spouts.pour(substep, [this](const Double3& position, const Double3& velocity, double mass, double rest) {
        begin(position, velocity, mass, std::min(rest, m_flown));
      });
  if (!failure.empty()) m_world.log("wetcloth: a spout or glass is not moved any more, its function threw: " + failure);
}

void Drops::Flight::begin(const Double3& from, const Double3& velocity, double mass, double rest) {
  m_state.accounts.poured.add(mass);
  ++m_state.counts.born;
  Double3 after;
  const double diameter = dropDiameter(mass, m_state.parameters.air.waterDensity);
  const DropPath path = pathOf(from, velocity, diameter, rest, after);
  const bool isLost = !areFinite(path.to) || !areFinite(after);
  const Hit hit = isLost ? Hit() : firstHit(path);
  if (isLost) {
    land(hit, {from, from}, velocity, mass);
  } else if (hit.isNone()) {
    m_state.drops.add(path.to, after, mass);
  } else {
    flyOn(land(hit, path, between(velocity, after, hit.time), mass));
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
