// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/WetCloth.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetClothWorld.h"
#include "bullet_wetcloth/mesh/FaceTree.h"
#include "bullet_wetcloth/mesh/MeshCheck.h"
#include "bullet_wetcloth/solver/ClothSolver.h"
#include "bullet_wetcloth/state/StateArchive.h"
#include "bullet_wetcloth/water/DryMass.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

std::vector<double> ofEach(const std::vector<Fabric>& fabrics, double Fabric::*field) {
  std::vector<double> values;
  for (const Fabric& fabric : fabrics) values.push_back(fabric.*field);
  return values;
}

}  // namespace

WetCloth::WetCloth(WetClothWorld& world, btSoftBody& body, std::vector<Fabric> fabrics, std::vector<int> fabricOfNode,
                   bool deformable)
    : m_world(world),
      m_body(body),
      m_fabrics(std::move(fabrics)),
      m_deformable(deformable),
      m_masses(body, deformable),
      m_linkConstants(body),
      m_restLengths(body),
      m_packedNodes(body, deformable),
      m_effects(*this),
      m_watch(body) {
  std::vector<double> masses = dryMasses(m_body, ofEach(m_fabrics, &Fabric::arealDensity), fabricOfNode);
  m_water.reset(std::move(masses), ofEach(m_fabrics, &Fabric::capacity), std::move(fabricOfNode));
  m_masses.remember();
}

WetCloth::~WetCloth() = default;

void WetCloth::log(const std::string& message) const { m_world.log(message); }

void WetCloth::setPace(const WaterPace& pace) {
  requireValid(pace);
  m_pace = pace;
}

// --- effects --------------------------------------------------------------------------------------------------------

Effect& WetCloth::add(std::unique_ptr<Effect> effect, const void* type) {
  if (!effect) reject("effect", "must not be null");
  m_world.requireBetweenSteps();
  followBody();
  if (m_effects.empty()) attachAgain();
  Effect& added = m_effects.add(std::move(effect), type);
  if (added.stage() == Stage::contact) m_world.shareTick();
  return added;
}

void WetCloth::remove(Effect& effect) {
  m_world.requireBetweenSteps();
  m_effects.remove(effect);
  m_world.shareTick();
}

void WetCloth::apply(Stage first, Stage last, const Step& step) {
  if (!m_effects.apply(first, last, step)) m_world.shareTick();
}

// --- the step, in the order of a substep ----------------------------------------------------------------------------

void WetCloth::observe(const Step& step) {
  if (!m_effects.has(Stage::observe) || !(step.dt > 0)) return;
  if (m_watch.hasChanged()) adaptToBody();
  apply(Stage::observe, Stage::observe, step);
}

void WetCloth::step(const Step& step) {
  if (!(step.dt > 0)) return;
  if (m_watch.hasChanged()) adaptToBody();
  const bool isIdle = m_effects.empty() && !m_water.movedSinceCommit();
  if (isIdle ? m_body.m_bUpdateRtCst : m_masses.seemSet()) takeOverMasses();
  followRestLengths();
  if (isIdle) return;
  followSolver();
  moveWater(step);
  tellSolver();
  if (isAwake(step)) apply(Stage::forces, Stage::elasticity, step);
  m_nodesAreBehind = packedNodes().areAhead();
  if (m_nodesAreBehind && !m_world.isHooked()) releaseNodes();
}

void WetCloth::moveWater(const Step& step) {
  const WaterClock::Turn turn = m_waterClock.tick(step.dt, m_pace.substepsOf(step.dt));
  if (!(turn.dt > 0)) return;
  const unsigned long long before = m_water.revision();
  apply(Stage::sources, Stage::material, {turn.dt, step.time + turn.start, step.gravity, step.fallShare});
  commitIfDue(m_water.revision() == before);
}

void WetCloth::commitIfDue(bool isAtRest) {
  if (m_water.movedSinceCommit() && (isAtRest || m_masses.areDue(m_water, m_pace.massTolerance))) {
    commit();
  } else if (m_linkConstants.areStale()) {
    m_linkConstants.refresh(m_masses.inverseMasses());
  }
}

PackedNodes& WetCloth::packedNodes() {
  ClothSolver* const solver = ClothSolver::of(m_body);
  PackedNodes* const nodes = solver ? solver->packedNodes(m_body) : nullptr;
  return nodes ? *nodes : m_packedNodes;
}

void WetCloth::releaseNodes() {
  packedNodes().release();
  m_nodesAreBehind = false;
}

void WetCloth::followSolver() {
  releaseNodes();
  if (packedNodes().order() != m_orderOfNodes) attachAgain();
}

void WetCloth::tellSolver() {
  ClothSolver* const solver = ClothSolver::of(m_body);
  if (solver) solver->setLinkStiffness(m_body, m_linkConstants.stiffness(), m_linkConstants.stiffnessRevision());
}

bool WetCloth::isGuarded() {
  ClothSolver* const solver = ClothSolver::of(m_body);
  return solver && solver->parameters().guard && solver->packedNodes(m_body);
}

void WetCloth::setLayerFriction(const std::vector<btScalar>& factors) {
  if (ClothSolver* const solver = ClothSolver::of(m_body)) solver->setLayerFriction(m_body, factors);
}

void WetCloth::setLayerCling(const std::vector<btScalar>& pull, const std::vector<btScalar>& shear) {
  if (ClothSolver* const solver = ClothSolver::of(m_body)) solver->setLayerCling(m_body, pull, shear);
}

// Masses and momentum, and then the links' constants, which follow from the masses.
void WetCloth::commit() {
  releaseNodes();
  const bool massesChanged = m_masses.commit(m_water);
  if (massesChanged || m_linkConstants.areStale()) m_linkConstants.refresh(m_masses.inverseMasses());
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
  const bool wakes = std::fabs(mass - m_massAsleep) > 0.01 * m_massAsleep || wakesBy(step);
  if (wakes) m_body.activate(true);
  return wakes;
}

bool WetCloth::wakesBy(const Step& step) {
  const std::size_t effects = m_effects.entries().size();
  const bool wakes = m_effects.wakes(step);
  if (m_effects.entries().size() != effects) m_world.shareTick();
  return wakes;
}

void WetCloth::commitExchange() {
  if (!m_watch.nodesChanged()) commitIfDue(false);
}

void WetCloth::spareBulletTheFaceTree() {
  const int flag = m_deformable ? btSoftBody::fCollision::SDF_RD : btSoftBody::fCollision::VF_SS;
  const bool makesTree = m_body.m_bUpdateRtCst && (m_body.m_cfg.collisions & flag);
  if (makesTree && !checkMesh(m_body).bulletBuildsFaceTree()) buildFaceTree(m_body);
}

void WetCloth::stepContacts(const Step& step) {
  if (!m_effects.has(Stage::contact) || !(step.dt > 0) || !m_body.isActive()) return;
  if (m_watch.hasChanged()) adaptToBody();
  apply(Stage::contact, Stage::contact, step);
}

// --- what the application did to the body ---------------------------------------------------------------------------

bool WetCloth::isOfThisBody() {
  const bool isUnstepped = m_body.m_bUpdateRtCst;  // as one that was just made, or whose masses were just set
  if (m_watch.enteredAnew() && isUnstepped) {
    m_isReplaced = m_isReplaced || m_hasStepped || m_watch.nodesChanged() || m_masses.wereSet();
  }
  m_hasStepped = m_hasStepped || !isUnstepped;
  return !m_isReplaced;
}

void WetCloth::followBody() {
  m_world.requireAttached();
  if (m_world.isInWorld(m_body) && !isOfThisBody()) {
    reject("body", "is another one than was added, at its address: add() it to the WetClothWorld");
  }
  if (m_watch.hasChanged()) adaptToBody();
  takeOverMasses();
}

// A body's first step sets the lengths of its links to what they are then: that is Bullet's way to begin, and no change
// of the shape at rest by the application.
void WetCloth::followRestLengths() {
  const bool beginsNow = m_body.m_bUpdateRtCst && !m_hasStepped;
  if (m_hasJustBegun && !beginsNow) m_restLengths.remember();
  m_hasJustBegun = beginsNow;
  if (!m_effects.empty() && m_restLengths.haveChanged()) attachAgain();
}

void WetCloth::takeOverMasses() {
  if (m_masses.takeOver(m_water)) commit();
}

// An application reads right after a cut, too.
void WetCloth::followCut() const {
  if (!m_world.isInWorld(m_body) || !m_watch.nodesChanged()) return;
  WetCloth& self = const_cast<WetCloth&>(*this);
  if (self.isOfThisBody()) self.adaptToBody();
}

void WetCloth::adaptToBody() {
  const int nodesBefore = m_watch.nodes();
  const bool nodesChanged = m_watch.nodesChanged();
  m_watch.remember();
  if (nodesChanged) {
    redistributeWater(m_body, ofEach(m_fabrics, &Fabric::arealDensity), m_water);
    m_masses.remember();
    if (m_water.movedSinceCommit()) commit();
    log("wetcloth: the body's nodes changed from " + std::to_string(nodesBefore) + " to " +
        std::to_string(m_body.m_nodes.size()) + "; its water is kept");
  }
  attachAgain();
}

// To a body whose mesh or shape at rest is another one.
void WetCloth::attachAgain() {
  m_orderOfNodes = packedNodes().order();
  m_restMesh.reset();
  m_restLengths.remember();
  if (!m_effects.attachAgain()) m_world.shareTick();
}

const RestMesh& WetCloth::restMesh() {
  if (!m_restMesh) m_restMesh.emplace(m_body, m_restLengths);
  return *m_restMesh;
}

// --- water ----------------------------------------------------------------------------------------------------------

void WetCloth::joinArrivals() {
  if (!m_water.movedSinceCommit()) return;
  releaseNodes();
  for (std::size_t i = 0; i < m_water.size(); ++i) joinArrivals(i);
}

int WetCloth::nodeCount() const {
  followCut();
  return static_cast<int>(m_water.size());
}

const Fabric& WetCloth::fabric(int node) const { return fabricOf(checked(node)); }
double WetCloth::saturation(int node) const { return m_water.saturation(checked(node)); }
double WetCloth::held(int node) const { return m_water.held(checked(node)); }
double WetCloth::dryMass(int node) const { return m_water.dryMass(checked(node)); }
double WetCloth::capacity(int node) const { return m_water.capacity(checked(node)); }

double WetCloth::meanSaturation() const {
  followCut();
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
  followBody();
  std::vector<double> held(m_water.size());
  for (std::size_t i = 0; i < held.size(); ++i) held[i] = saturation * m_water.capacity(i);
  setHeld(held);
}

void WetCloth::setHeld(const std::vector<double>& held) {
  followBody();
  if (held.size() != m_water.size()) {
    rejectValue("held.size()", held.size(), "the number of nodes, " + std::to_string(m_water.size()));
  }
  for (std::size_t i = 0; i < held.size(); ++i) requireNotNegative("held[" + std::to_string(i) + "]", held[i]);
  m_water.setHeld(held);
  commit();
}

double WetCloth::totalMass() const {
  followCut();
  double mass = 0;
  for (std::size_t i = 0; i < m_water.size(); ++i) mass += m_water.totalMass(i);
  return mass;
}

std::size_t WetCloth::checked(int node) const {
  followCut();
  if (node < 0 || static_cast<std::size_t>(node) >= m_water.size()) {
    throw std::out_of_range("node = " + std::to_string(node) + ": must be in [0, " + std::to_string(m_water.size()) +
                            ")");
  }
  return static_cast<std::size_t>(node);
}

// --- looks ----------------------------------------------------------------------------------------------------------

Colour WetCloth::colour(int node) const {
  const std::size_t i = checked(node);
  const std::array<double, 3>& dry = fabricOf(i).dryColour;
  return wetColour({dry[0], dry[1], dry[2]}, m_water.saturation(i));
}

double WetCloth::roughness(int node) const {
  const std::size_t i = checked(node);
  return wetRoughness(fabricOf(i).dryRoughness, m_water.saturation(i));
}

// --- save and restore -----------------------------------------------------------------------------------------------

void WetCloth::transferState(StateArchive& archive) {
  if (archive.isRestoring() && m_world.isInWorld(m_body)) followSolver();
  archive.expect(m_water.size(), "a cloth's number of nodes");
  archive.expect(m_world.isInWorld(m_body), "whether a cloth's body is in the world");
  archive.value(m_massAsleep, m_wasPresent, m_hasJustBegun);
  m_waterClock.transferState(archive);
  m_water.transferState(archive);
  m_masses.transferState(archive);
  m_linkConstants.transferState(archive);
  m_restLengths.transferState(archive);
  transferMesh(archive);
  m_effects.transferState(archive);
}

// It is built when first asked for, of the body as it is then.
void WetCloth::transferMesh(StateArchive& archive) {
  unsigned char has = m_restMesh ? 1 : 0;
  archive.local(has);
  if (has == 0) return;
  if (!m_restMesh && !m_world.isInWorld(m_body)) archive.fail("a cloth's triangles are saved, and its body is gone");
  if (!m_restMesh && archive.isChecking()) {
    RestMesh(m_body).transferState(archive);
  } else {
    m_restMesh ? m_restMesh->transferState(archive) : m_restMesh.emplace(m_body).transferState(archive);
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
