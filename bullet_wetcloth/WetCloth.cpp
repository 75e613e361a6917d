// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/WetCloth.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetClothWorld.h"
#include "bullet_wetcloth/state/StateArchive.h"
#include "bullet_wetcloth/water/DryMass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

WetCloth::WetCloth(WetClothWorld& world, btSoftBody& body, Fabric fabric, bool deformable)
    : m_world(world), m_body(body), m_fabric(std::move(fabric)), m_deformable(deformable), m_masses(body, deformable) {
  m_water.reset(dryMasses(m_body, m_fabric.arealDensity), m_fabric.capacity);
  m_masses.remember();
  rememberBody();
}

WetCloth::~WetCloth() = default;

Effect& WetCloth::add(std::unique_ptr<Effect> effect) {
  if (!effect) reject("effect", "must not be null");
  if (bodyChanged()) adaptToBody();
  effect->attach(*this);
  const auto isLater = [](Stage stage, const std::unique_ptr<Effect>& other) { return stage < other->stage(); };
  const auto position = std::upper_bound(m_effects.begin(), m_effects.end(), effect->stage(), isLater);
  Effect& added = **m_effects.insert(position, std::move(effect));
  if (added.stage() == Stage::contact) m_world.shareTick();
  return added;
}

void WetCloth::remove(Effect& effect) {
  const auto isIt = [&](const std::unique_ptr<Effect>& other) { return other.get() == &effect; };
  const auto position = std::find_if(m_effects.begin(), m_effects.end(), isIt);
  if (position == m_effects.end()) reject(std::string("effect ") + effect.name(), "is not one of this cloth's effects");
  effect.detach(*this);
  m_effects.erase(position);
  m_world.shareTick();
}

double WetCloth::saturation(int node) const { return m_water.saturation(checked(node)); }
double WetCloth::held(int node) const { return m_water.held(checked(node)); }
double WetCloth::dryMass(int node) const { return m_water.dryMass(checked(node)); }
double WetCloth::capacity(int node) const { return m_water.capacity(checked(node)); }

double WetCloth::meanSaturation() const {
  double held = 0;
  double capacity = 0;
  for (std::size_t i = 0; i < m_water.size(); ++i) {
    held += m_water.held(i);
    capacity += m_water.capacity(i);
  }
  return held / capacity;
}

void WetCloth::setSaturation(double saturation) {
  requireFraction("saturation", saturation);
  if (bodyChanged()) adaptToBody();
  std::vector<double> held(m_water.size());
  for (std::size_t i = 0; i < held.size(); ++i) held[i] = saturation * m_water.capacity(i);
  setHeld(held);
}

void WetCloth::setHeld(const std::vector<double>& held) {
  if (bodyChanged()) adaptToBody();
  if (held.size() != m_water.size()) {
    rejectValue("held.size()", held.size(), "the number of nodes, " + std::to_string(m_water.size()));
  }
  for (std::size_t i = 0; i < held.size(); ++i) requireNotNegative("held[" + std::to_string(i) + "]", held[i]);
  m_water.setHeld(held);
  m_masses.commit(m_water);
}

Colour WetCloth::colour(int node) const {
  const std::array<double, 3>& dry = m_fabric.dryColour;
  return wetColour({dry[0], dry[1], dry[2]}, saturation(node));
}

double WetCloth::roughness(int node) const { return wetRoughness(m_fabric.dryRoughness, saturation(node)); }

const RestMesh& WetCloth::restMesh() {
  if (!m_restMesh) m_restMesh.emplace(m_body);
  return *m_restMesh;
}

void WetCloth::joinArrivals() {
  if (!m_water.movedSinceCommit()) return;
  for (std::size_t i = 0; i < m_water.size(); ++i) joinArrivals(i);
}

void WetCloth::log(const std::string& message) const { m_world.log(message); }

// Calls `action` on the effect at `index` and moves on to the next. Effects of ours do not throw here, but a user's
// own may, and an exception must not travel through Bullet's step: that effect is removed, with a message.
template <class Action>
void WetCloth::guarded(std::size_t& index, Action action) {
  std::string reason;
  try {
    action(*m_effects[index]);
    ++index;
    return;
  } catch (const std::exception& error) {
    reason = error.what();
  } catch (...) {
    reason = "an exception that is no std::exception";
  }
  log(std::string("wetcloth: effect ") + m_effects[index]->name() + " removed: " + reason);
  const std::unique_ptr<Effect> failed = std::move(m_effects[index]);
  m_effects.erase(m_effects.begin() + static_cast<std::ptrdiff_t>(index));
  detachGuarded(*failed);
  m_world.shareTick();
}

void WetCloth::detachGuarded(Effect& effect) {
  try {
    effect.detach(*this);
  } catch (...) {
    log(std::string("wetcloth: effect ") + effect.name() + " could not give back what it changed");
  }
}

void WetCloth::step(const Step& step) {
  if ((m_effects.empty() && !m_water.movedSinceCommit()) || !(step.dt > 0)) return;
  if (bodyChanged()) adaptToBody();
  std::size_t next = 0;
  const auto run = [&](Effect& effect) { effect.apply(*this, step); };
  while (next < m_effects.size() && m_effects[next]->stage() < Stage::forces) guarded(next, run);
  if (m_water.movedSinceCommit()) m_masses.commit(m_water);
  if (!isAwake(step)) return;
  while (next < m_effects.size() && m_effects[next]->stage() < Stage::contact) guarded(next, run);
}

void WetCloth::commitExchange() {
  if (m_water.movedSinceCommit() && m_body.m_nodes.size() == m_nodeCount) m_masses.commit(m_water);
}

void WetCloth::stepContacts(const Step& step) {
  if (!hasContactEffects() || !(step.dt > 0) || !m_body.isActive()) return;
  if (bodyChanged()) adaptToBody();
  std::size_t next = 0;
  while (next < m_effects.size() && m_effects[next]->stage() < Stage::contact) ++next;
  while (next < m_effects.size()) guarded(next, [&](Effect& effect) { effect.apply(*this, step); });
}

// Bullet adds no gravity to a sleeping body, and what we would push against it would move the cloth all the same. So
// forces rest, too; but a cloth whose mass has changed by 1 % since it fell asleep hangs differently, and wakes.
bool WetCloth::isAwake(const Step& step) {
  if (m_body.isActive()) {
    m_massAsleep = 0;
    return true;
  }
  const double mass = totalMass();
  if (m_massAsleep == 0) m_massAsleep = mass;
  bool wakes = std::fabs(mass - m_massAsleep) > 0.01 * m_massAsleep;
  for (const auto& effect : m_effects) wakes = wakes || effect->wakes(*this, step);
  if (wakes) m_body.activate(true);
  return wakes;
}

double WetCloth::totalMass() const {
  double mass = 0;
  for (std::size_t i = 0; i < m_water.size(); ++i) mass += m_water.totalMass(i);
  return mass;
}

void WetCloth::releaseEffects() {
  for (const auto& effect : m_effects) detachGuarded(*effect);
  m_effects.clear();
}

bool WetCloth::bodyChanged() const {
  return m_body.m_nodes.size() != m_nodeCount || m_body.m_links.size() != m_linkCount ||
         m_body.m_faces.size() != m_faceCount;
}

void WetCloth::rememberBody() {
  m_restMesh.reset();
  m_nodeCount = m_body.m_nodes.size();
  m_linkCount = m_body.m_links.size();
  m_faceCount = m_body.m_faces.size();
}

void WetCloth::adaptToBody() {
  if (m_body.m_nodes.size() != m_nodeCount) {
    log("wetcloth: the body's nodes changed from " + std::to_string(m_nodeCount) + " to " +
        std::to_string(m_body.m_nodes.size()) + "; its water is kept");
    redistributeWater(m_body, m_fabric.arealDensity, m_water);
    m_masses.remember();
    m_masses.commit(m_water);
  }
  rememberBody();
  for (std::size_t i = 0; i < m_effects.size();) guarded(i, [&](Effect& effect) { effect.attach(*this); });
}

std::size_t WetCloth::checked(int node) const {
  if (node < 0 || static_cast<std::size_t>(node) >= m_water.size()) {
    throw std::out_of_range("node = " + std::to_string(node) + ": must be in [0, " + std::to_string(m_water.size()) +
                            ")");
  }
  return static_cast<std::size_t>(node);
}

void WetCloth::transferState(StateArchive& archive) {
  archive.expect(m_water.size(), "a cloth's number of nodes");
  archive.expect(m_world.isInWorld(m_body), "whether a cloth's body is in the world");
  archive.value(m_massAsleep, m_wasPresent);
  m_water.transferState(archive);
  m_masses.transferState(archive);
  transferMesh(archive);
  archive.expect(m_effects.size(), "a cloth's number of effects");
  for (const auto& effect : m_effects) {
    const std::string name = effect->name();
    archive.expect(name, "an effect's name");
    archive.section("the effect " + name, [&] { effect->transferState(archive); });
  }
}

// It is built when first asked for, of the body as it is then.
void WetCloth::transferMesh(StateArchive& archive) {
  unsigned char has = m_restMesh ? 1 : 0;
  archive.local(has);
  if (has == 0) return;
  if (!m_restMesh && archive.isChecking()) {
    RestMesh(m_body).transferState(archive);
  } else {
    m_restMesh ? m_restMesh->transferState(archive) : m_restMesh.emplace(m_body).transferState(archive);
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
