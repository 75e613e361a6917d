// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/WetClothWorld.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WorldPart.h"
#include "bullet_wetcloth/bullet/RunningMark.h"
#include "bullet_wetcloth/bullet/SubstepHook.h"
#include "bullet_wetcloth/bullet/Versions.h"
#include "bullet_wetcloth/solver/ClothSolver.h"
#include "bullet_wetcloth/state/StateArchive.h"
#include "bullet_wetcloth/state/StateEnvelope.h"
#include "bullet_wetcloth/state/WorldState.h"

#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Null when the world is none of Bullet's three worlds with soft bodies.
const btAlignedObjectArray<btSoftBody*>* softBodiesOf(const btDynamicsWorld& world) {
  switch (world.getWorldType()) {
    case BT_SOFT_RIGID_DYNAMICS_WORLD: return &static_cast<const btSoftRigidDynamicsWorld&>(world).getSoftBodyArray();
    case BT_SOFT_MULTIBODY_DYNAMICS_WORLD:
      return &static_cast<const btSoftMultiBodyDynamicsWorld&>(world).getSoftBodyArray();
    case BT_DEFORMABLE_MULTIBODY_DYNAMICS_WORLD:
      return &static_cast<const btDeformableMultiBodyDynamicsWorld&>(world).getSoftBodyArray();
    default: return nullptr;
  }
}

bool isDeformable(const btDynamicsWorld& world) {
  return world.getWorldType() == BT_DEFORMABLE_MULTIBODY_DYNAMICS_WORLD;
}

void requireValid(const std::vector<Fabric>& fabrics, const std::vector<int>& fabricOfNode, int nodes) {
  if (fabrics.empty()) rejectValue("fabrics.size()", 0, "at least 1");
  for (std::size_t k = 0; k < fabrics.size(); ++k) requireValid(fabrics[k], "fabrics[" + std::to_string(k) + "]");
  if (fabricOfNode.size() != static_cast<std::size_t>(nodes)) {
    rejectValue("fabricOfNode.size()", fabricOfNode.size(), "the number of nodes, " + std::to_string(nodes));
  }
  for (std::size_t i = 0; i < fabricOfNode.size(); ++i) {
    if (fabricOfNode[i] >= 0 && static_cast<std::size_t>(fabricOfNode[i]) < fabrics.size()) continue;
    rejectValue("fabricOfNode[" + std::to_string(i) + "]", fabricOfNode[i],
                "in [0, " + std::to_string(fabrics.size()) + ")");
  }
}

bool hasGravityForce(btDeformableBodySolver& solver) {
  const btAlignedObjectArray<btDeformableLagrangianForce*>& forces = solver.m_objective->m_lf;
  for (int i = 0; i < forces.size(); ++i) {
    if (forces[i]->getForceType() == BT_GRAVITY_FORCE) return true;
  }
  return false;
}

}  // namespace

WetClothWorld::WetClothWorld(btDynamicsWorld& world, Hook hook, const Layout& caller)
    : m_world((requireLayout(caller, kLayout), world)),
      m_hook(hook),
      m_log([](const std::string& message) { std::clog << message << '\n'; }) {
  if (!softBodiesOf(world)) {
    rejectValue("world.getWorldType()", static_cast<int>(world.getWorldType()),
                "that of a btSoftRigidDynamicsWorld, btSoftMultiBodyDynamicsWorld or "
                "btDeformableMultiBodyDynamicsWorld");
  }
  m_substepHook = std::make_unique<SubstepHook>(
      world, [this](btScalar dt) { preTick(dt); }, [this](btScalar dt) { tick(dt); });
  if (hook == Hook::preTick) m_substepHook->take(SubstepHook::Slot::preTick);
}

WetClothWorld::~WetClothWorld() {
  leavePart();
  if (!m_cloths.empty()) detach();
}

void WetClothWorld::leavePart() {
  if (!m_part) return;
  for (const auto& cloth : m_cloths) m_part->forget(*cloth);
  m_part->m_world = nullptr;
  m_part = nullptr;
}

void WetClothWorld::detach() {
  leavePart();
  for (const auto& cloth : m_cloths) {
    if (isInWorld(cloth->m_body) && cloth->isOfThisBody()) cloth->m_effects.clear();
  }
  m_cloths.clear();
  if (!m_substepHook) return;
  m_substepHook->giveBack(SubstepHook::Slot::preTick);
  m_substepHook->giveBack(SubstepHook::Slot::tick);
  m_substepHook.reset();
  m_sharesTick = false;
}

void WetClothWorld::requireAttached() const {
  if (!m_substepHook) reject("WetClothWorld", "is detached from its world, or that was deleted");
}

// Bullet tells nobody; but a body that was in the world shows it. It is only asked of one that the caller holds: others
// may have been deleted, and only the world can tell of them.
void WetClothWorld::noticeDeletion(const WetCloth& cloth) {
  if (!m_substepHook || !cloth.lostItsWorld()) return;
  m_substepHook.reset();
  m_sharesTick = false;
  log("wetcloth: the world was deleted before its WetClothWorld; destroy that first, or call its detach()");
}

WetCloth& WetClothWorld::add(btSoftBody& body, const Fabric& fabric) {
  requireValid(fabric);
  return add(body, {fabric}, std::vector<int>(static_cast<std::size_t>(body.m_nodes.size()), 0));
}

WetCloth& WetClothWorld::add(btSoftBody& body, std::vector<Fabric> fabrics, std::vector<int> fabricOfNode) {
  requireBetweenSteps();
  if (const WetCloth* const known = find(body)) noticeDeletion(*known);
  requireAttached();
  requireValid(fabrics, fabricOfNode, body.m_nodes.size());
  if (BodyWatch(body).lostItsWorld() || !isInWorld(body)) {
    reject("body", "is not in this world; add it to the world first");
  }
  if (WetCloth* const known = find(body)) {
    if (known->isOfThisBody()) reject("body", "was added already");
    forget(*known);
  }
  if (isReduced(body)) reject("body", "is a reduced deformable body: it moves by its modes and reads no node's mass");
  warnOfMissingGravity(body);
  if (m_hook == Hook::preTick && !isHooked()) {
    log("wetcloth: another pre-tick callback has replaced ours; no cloth will get wet unless it calls preTick()");
  }
  m_cloths.push_back(std::unique_ptr<WetCloth>(
      new WetCloth(*this, body, std::move(fabrics), std::move(fabricOfNode), isDeformable(m_world))));
  if (m_part) m_part->follow(*m_cloths.back());
  return *m_cloths.back();
}

WetCloth& WetClothWorld::add(btSoftBody* body, const Fabric& fabric) {
  if (!body) reject("body", "must not be null");
  return add(*body, fabric);
}

WetCloth& WetClothWorld::add(btSoftBody* body, std::vector<Fabric> fabrics, std::vector<int> fabricOfNode) {
  if (!body) reject("body", "must not be null");
  return add(*body, std::move(fabrics), std::move(fabricOfNode));
}

void WetClothWorld::remove(btSoftBody& body) {
  requireBetweenSteps();
  const auto wraps = [&](const std::unique_ptr<WetCloth>& cloth) { return &cloth->body() == &body; };
  const auto position = std::find_if(m_cloths.begin(), m_cloths.end(), wraps);
  if (position == m_cloths.end()) reject("body", "was not added to this WetClothWorld");
  noticeDeletion(**position);
  if (m_part) m_part->forget(**position);
  if (!isInWorld(body) || (*position)->isOfThisBody()) (*position)->m_effects.clear();
  m_cloths.erase(position);
  shareTick();
}

// Whose body is gone: there is nothing to give back.
void WetClothWorld::forget(const WetCloth& cloth) {
  if (m_part) m_part->forget(cloth);
  const auto isIt = [&](const std::unique_ptr<WetCloth>& other) { return other.get() == &cloth; };
  m_cloths.erase(std::find_if(m_cloths.begin(), m_cloths.end(), isIt));
  shareTick();
}

const WetCloth* WetClothWorld::find(const btSoftBody& body) const {
  for (const auto& cloth : m_cloths) {
    if (&cloth->body() == &body) return cloth.get();
  }
  return nullptr;
}

WetCloth* WetClothWorld::find(const btSoftBody& body) {
  return const_cast<WetCloth*>(static_cast<const WetClothWorld*>(this)->find(body));
}

BodyFilms* WetClothWorld::films() const { return m_part ? m_part->films() : nullptr; }

bool WetClothWorld::isHooked() const {
  return m_hook == Hook::preTick && m_substepHook && m_substepHook->isInPlace(SubstepHook::Slot::preTick);
}

bool WetClothWorld::isTickHooked() const { return m_sharesTick && m_substepHook->isInPlace(SubstepHook::Slot::tick); }

void WetClothWorld::requireBetweenSteps() const {
  if (m_isStepping) reject("WetClothWorld", "is in a step; cloths and effects come and go between steps");
}

void WetClothWorld::preTick(btScalar dt) {
  if (!m_substepHook || !(std::isfinite(dt) && dt > 0)) return;
  const RunningMark stepping(m_isStepping);
  m_stepStart = m_time;
  for (const auto& cloth : m_cloths) {
    if (noticePresence(*cloth)) cloth->observe(stepOf(cloth->m_body, dt, m_time));
  }
  for (const auto& cloth : m_cloths) {
    if (noticePresence(*cloth)) cloth->step(stepOf(cloth->m_body, dt, m_time));
  }
  if (m_part) m_part->step(static_cast<double>(dt), m_time);
  for (const auto& cloth : m_cloths) {
    if (!cloth->m_wasPresent) continue;
    cloth->commitExchange();
    cloth->spareBulletTheFaceTree();
  }
  m_time += static_cast<double>(dt);
}

void WetClothWorld::tick(btScalar dt) {
  if (!m_substepHook || !(std::isfinite(dt) && dt > 0)) return;
  const RunningMark stepping(m_isStepping);
  for (const auto& cloth : m_cloths) {
    if (noticePresence(*cloth)) cloth->stepContacts(stepOf(cloth->m_body, dt, m_stepStart));
  }
}

// Bullet's tick callback is shared while a cloth needs it, and only then.
void WetClothWorld::shareTick() {
  if (m_hook != Hook::preTick || !m_substepHook) return;
  const auto needs = [](const std::unique_ptr<WetCloth>& cloth) { return cloth->m_effects.has(Stage::contact); };
  const bool isNeeded = std::any_of(m_cloths.begin(), m_cloths.end(), needs);
  if (isNeeded && !m_sharesTick) m_substepHook->take(SubstepHook::Slot::tick);
  if (!isNeeded && m_sharesTick) m_substepHook->giveBack(SubstepHook::Slot::tick);
  m_sharesTick = isNeeded;
  if (isNeeded && !isTickHooked()) {
    log("wetcloth: another tick callback has replaced ours; no effect of the stage contact will run unless it calls "
        "tick()");
  }
}

// A body that left the world may have been deleted, so only its address is looked at.
bool WetClothWorld::noticePresence(WetCloth& cloth) const {
  const bool isInPlace = isInWorld(cloth.m_body);
  const bool isPresent = isInPlace && cloth.isOfThisBody();
  if (isPresent != cloth.m_wasPresent) {
    cloth.m_wasPresent = isPresent;
    log(isPresent   ? "wetcloth: a body came back to the world; its effects run again"
        : isInPlace ? "wetcloth: a body was taken out of the world, and another one is in its place; add that one"
                    : "wetcloth: a body left the world; its effects rest until it comes back");
  }
  return isPresent;
}

// Whether steps are implicit is told to nobody before the first.
void WetClothWorld::warnOfMissingGravity(const btSoftBody& body) const {
  auto* const solver = isDeformable(m_world) ? static_cast<btDeformableBodySolver*>(body.getSoftBodySolver()) : nullptr;
  if (!solver || hasGravityForce(*solver)) return;
  log("wetcloth: no btDeformableGravityForce is in this world; an implicit step then takes a variable that Bullet "
      "never "
      "set for gravity, and may come to NaN. Add one before such a step, of gravity 0 where there is none");
}

Step WetClothWorld::stepOf(const btSoftBody& body, btScalar dt, double time) const {
  // The deformable world integrates with its own step and leaves the body's timescale aside.
  const double timescale = isDeformable(m_world) ? 1 : static_cast<double>(body.m_cfg.timescale);
  return {static_cast<double>(dt) * timescale, time, gravityOf(body), fallShareOf(body, dt)};
}

double WetClothWorld::fallShareOf(const btSoftBody& body, btScalar dt) const {
  const ClothSolver* const solver = ClothSolver::of(body);
  const int count = solver ? solver->smallStepsIn(body, static_cast<double>(dt)) : 0;
  return count > 0 ? (count + 1) / (2.0 * count) : 1;
}

btVector3 WetClothWorld::gravityOf(const btSoftBody& body) const {
  if (!isDeformable(m_world)) return body.m_worldInfo->m_gravity;
  btVector3 gravity(0, 0, 0);
  auto* solver = static_cast<btDeformableBodySolver*>(body.getSoftBodySolver());
  if (!solver) return gravity;
  const btAlignedObjectArray<btDeformableLagrangianForce*>& forces = solver->m_objective->m_lf;
  for (int i = 0; i < forces.size(); ++i) {
    if (forces[i]->getForceType() != BT_GRAVITY_FORCE) continue;
    for (int k = 0; k < forces[i]->m_softBodies.size(); ++k) {
      if (forces[i]->m_softBodies[k] == &body) gravity += static_cast<btDeformableGravityForce*>(forces[i])->m_gravity;
    }
  }
  return gravity * body.m_gravityFactor;
}

const btAlignedObjectArray<btSoftBody*>& WetClothWorld::softBodies() const {
  static const btAlignedObjectArray<btSoftBody*> none;
  const btAlignedObjectArray<btSoftBody*>* const bodies = m_substepHook ? softBodiesOf(m_world) : nullptr;
  return bodies ? *bodies : none;
}

bool WetClothWorld::isInWorld(const btSoftBody& body) const {
  const btAlignedObjectArray<btSoftBody*>& bodies = softBodies();
  for (int i = 0; i < bodies.size(); ++i) {
    if (bodies[i] == &body) return true;
  }
  return false;
}

void WetClothWorld::setLog(std::function<void(const std::string&)> log) { m_log = std::move(log); }

void WetClothWorld::log(const std::string& message) const {
  if (!m_log) return;
  try {
    m_log(message);
  } catch (...) {  // it must not travel through Bullet's step
  }
}

void WetClothWorld::save(std::ostream& stream) const {
  requireAttached();
  StateArchive archive(m_world);
  const_cast<WetClothWorld*>(this)->transferState(archive);  // which changes nothing that the next step would not
  StateEnvelope::write(stream, static_cast<std::uint32_t>(m_world.getWorldType()), archive.bytes());
}

void WetClothWorld::restore(std::istream& stream) {
  requireAttached();
  StateArchive archive(m_world, StateEnvelope::read(stream, static_cast<std::uint32_t>(m_world.getWorldType())));
  transferState(archive);
  archive.rewind();
  transferState(archive);
}

void WetClothWorld::transferState(StateArchive& archive) {
  for (const auto& cloth : m_cloths) cloth->followCut();
  transferWorld(archive, static_cast<btDiscreteDynamicsWorld&>(m_world), softBodies());
  transferSolver(archive);
  archive.value(m_time, m_stepStart);
  archive.expect(m_cloths.size(), "the number of cloths");
  for (const auto& cloth : m_cloths) {
    archive.expect(softBodies().findLinearSearch(&cloth->m_body), "a cloth's place among the world's soft bodies");
    cloth->transferState(archive);
  }
  archive.expect(m_part != nullptr, "whether there are drops");
  if (m_part) archive.section("the drops", [&] { m_part->transferState(archive); });
}

void WetClothWorld::transferSolver(StateArchive& archive) const {
  ClothSolver* const solver = softBodies().size() > 0 ? ClothSolver::of(*softBodies()[0]) : nullptr;
  archive.expect(solver != nullptr, "whether a ClothSolver steps the soft bodies");
  if (solver) solver->transferState(archive, softBodies());
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
