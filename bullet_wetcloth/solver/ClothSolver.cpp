// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/ClothSolver.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/mesh/FaceTree.h"
#include "bullet_wetcloth/solver/ClothGuard.h"
#include "bullet_wetcloth/solver/Entanglements.h"
#include "bullet_wetcloth/solver/GuardBodies.h"
#include "bullet_wetcloth/solver/GuardContacts.h"
#include "bullet_wetcloth/solver/PackedCloth.h"
#include "bullet_wetcloth/solver/SmallStepCount.h"
#include "bullet_wetcloth/solver/SmallStepViewers.h"
#include "bullet_wetcloth/solver/WhyNotTaken.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <mutex>
#include <utility>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

void requireValid(const ClothSolver::Parameters& parameters) {
  constexpr int kMostSmallSteps = 1000;
  if (parameters.smallSteps < 1 || parameters.smallSteps > kMostSmallSteps) {
    rejectValue("ClothSolver.smallSteps", parameters.smallSteps, "in [1, 1000]");
  }
  if (!(parameters.stiffness > 0)) rejectValue("ClothSolver.stiffness", parameters.stiffness, "> 0");
  constexpr int kMostTethers = 8;
  if (parameters.tethers < 0 || parameters.tethers > kMostTethers) {
    rejectValue("ClothSolver.tethers", parameters.tethers, "in [0, 8]");
  }
  if (!(parameters.tetherScale >= 1)) rejectValue("ClothSolver.tetherScale", parameters.tetherScale, ">= 1");
  requireFiniteScalar("ClothSolver.tetherScale", parameters.tetherScale);
  if (!parameters.guard) return;
  requireNotNegative("ClothSolver.guard.thickness", parameters.guard->thickness);
  requireNotNegative("ClothSolver.guard.friction", parameters.guard->friction);
  constexpr int kMostAhead = 100;
  if (parameters.guard->every < 1 || parameters.guard->every > kMostAhead) {
    rejectValue("ClothSolver.guard.every", parameters.guard->every, "in [1, 100]");
  }
}

// All that live. Of a body only the address of its solver is known, which may be of any class.
class Registry {
 public:
  static void add(ClothSolver& solver) {
    const std::lock_guard<std::mutex> lock(mutex());
    solvers().push_back(&solver);
  }
  static void remove(ClothSolver& solver) {
    const std::lock_guard<std::mutex> lock(mutex());
    solvers().erase(std::find(solvers().begin(), solvers().end(), &solver));
  }
  static ClothSolver* find(const btSoftBodySolver* address) {
    const std::lock_guard<std::mutex> lock(mutex());
    const auto found = std::find(solvers().begin(), solvers().end(), address);
    return found == solvers().end() ? nullptr : *found;
  }

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  static std::vector<ClothSolver*>& solvers() {
    static std::vector<ClothSolver*> all;
    return all;
  }
};

// To Bullet, which collides by a tree of faces, and makes it in a body's first step only.
void giveBack(btSoftBody& body) {
  if (collidesWithSoftBodies(body) && body.m_fdbvt.empty() && !body.m_bUpdateRtCst) buildFaceTree(body);
}

}  // namespace

class ClothSolver::Impl {
 public:
  // A cloth that was taken, and what was said about it.
  struct Taken {
    explicit Taken(btSoftBody& body) : cloth(body) {}
    PackedCloth cloth;
    unsigned long long linksSeen = 0;  // PackedCloth::linksTaken() when small steps were last counted
    int smallStepsSeen = 0;
    bool isStuck = false;
  };

  Taken* find(const btSoftBody& body) {
    for (const auto& taken : cloths) {
      if (&taken->cloth.body() == &body) return taken.get();
    }
    return nullptr;
  }

  const char* whyNotTaken(const btSoftBody& body) const;
  void seeWhoIsLeft(const btAlignedObjectArray<btSoftBody*>& softBodies);

  void log(const std::string& message) const {
    try {
      if (logger) logger(message);
    } catch (...) {  // a step never throws
    }
  }

  void solveGuarded(const btAlignedObjectArray<btSoftBody*>& softBodies, btScalar dt);
  void takeGuarded(const btAlignedObjectArray<btSoftBody*>& softBodies);
  void beginGuard(int smallSteps);
  void warnOfBadNode(Taken& taken) const;
  void warnOfSmallSteps(Taken& taken) const;

  Parameters parameters;
  std::vector<std::unique_ptr<Taken>> cloths;  // of bodies that are in the world
  std::vector<std::unique_ptr<Taken>> before;  // room for those of the step before, so that no step allocates
  ClothGuard guard;
  std::vector<PackedCloth*> guarded;            // in this step
  std::vector<PackedCloth*> inContact;          // these, and those that stand
  Entanglements::Cloths all;                    // theirs
  std::vector<ClothGuard::Cloth> guardedNodes;  // the same, and rigid bodies
  Entanglements entanglements;
  GuardBodies bodies;
  std::vector<GuardBodies::Cloth> amongBodies;  // those that are guarded
  long long mostInside = 0;
  bool isOneLeft = false;  // to Bullet, that collides with soft bodies
  SmallStepViewers viewers;
  std::function<void(const std::string&)> logger = [](const std::string& message) { std::clog << message << '\n'; };
};

// Bullet's contacts and the guard's do not know each other: of the bodies that collide all are taken, or none.
const char* ClothSolver::Impl::whyNotTaken(const btSoftBody& body) const {
  const char* const why = wetcloth::whyNotTaken(body);
  if (why[0] != '\0' || !collidesWithSoftBodies(body)) return why;
  if (!parameters.guard || !parameters.guard->others) {
    return "it collides with other soft bodies, and stays with Bullet unless the guard is on for others";
  }
  return isOneLeft ? "it collides with other soft bodies, one of which is left to Bullet" : "";
}

void ClothSolver::Impl::seeWhoIsLeft(const btAlignedObjectArray<btSoftBody*>& softBodies) {
  isOneLeft = false;
  for (int k = 0; k < softBodies.size(); ++k) {
    isOneLeft =
        isOneLeft || (collidesWithSoftBodies(*softBodies[k]) && wetcloth::whyNotTaken(*softBodies[k])[0] != '\0');
  }
}

void ClothSolver::Impl::warnOfBadNode(Taken& taken) const {
  const int node = taken.cloth.badNode();
  if (node >= 0 && !taken.isStuck) {
    log("wetcloth: node " + std::to_string(node) + " of a cloth is not finite; the cloth is not stepped until it is");
  }
  taken.isStuck = node >= 0;
}

// Counted again when links or the number of small steps have changed.
void ClothSolver::Impl::warnOfSmallSteps(Taken& taken) const {
  if (taken.linksSeen == taken.cloth.linksTaken() && taken.smallStepsSeen == parameters.smallSteps) return;
  taken.linksSeen = taken.cloth.linksTaken();
  taken.smallStepsSeen = parameters.smallSteps;
  const int needed = taken.cloth.smallStepsFor();
  if (needed <= parameters.smallSteps) return;
  log("wetcloth: a cloth's links stretch further than their stiffness says: that takes " + std::to_string(needed) +
      " small steps in 1/60 s, and ClothSolver has " + std::to_string(parameters.smallSteps));
}

ClothSolver::ClothSolver() : ClothSolver(Parameters()) {}

ClothSolver::ClothSolver(const Parameters& parameters) : m_impl(std::make_unique<Impl>()) {
  setParameters(parameters);
  Registry::add(*this);
}

ClothSolver::~ClothSolver() { Registry::remove(*this); }

ClothSolver* ClothSolver::of(const btSoftBody& body) { return Registry::find(body.getSoftBodySolver()); }

const ClothSolver::Parameters& ClothSolver::parameters() const { return m_impl->parameters; }

void ClothSolver::setParameters(const Parameters& parameters) {
  requireValid(parameters);
  m_impl->parameters = parameters;
}

std::string ClothSolver::reasonNotTaken(const btSoftBody& body) const {
  std::string why = m_impl->whyNotTaken(body);
  if (!why.empty()) return why;
  const Impl::Taken* const taken = m_impl->find(body);
  if (taken && taken->isStuck) return "node " + std::to_string(taken->cloth.badNode()) + " is not finite";
  return "";
}

int ClothSolver::smallStepsFor(const btSoftBody& body) const {
  const Impl::Taken* const taken = m_impl->find(body);
  return taken ? taken->cloth.smallStepsFor() : 1;
}

int ClothSolver::smallStepsOf(const Parameters& parameters, double dt) {
  return SmallStepCount::inSteadySteps(parameters, dt);
}

int ClothSolver::smallStepsIn(const btSoftBody& body, double dt) const {
  const Impl::Taken* const taken = m_impl->find(body);
  return taken ? taken->cloth.smallStepsIn(m_impl->parameters, dt) : 0;
}

void ClothSolver::setLinkStiffness(const btSoftBody& body, const std::vector<btScalar>& factors,
                                   unsigned long long revision) {
  if (Impl::Taken* const taken = m_impl->find(body)) taken->cloth.setLinkStiffness(factors, revision);
}

namespace {

void replaceBad(std::vector<btScalar>& values, btScalar replacement) {
  const auto isBad = [](btScalar value) { return !(value >= 0 && std::isfinite(value)); };
  std::replace_if(values.begin(), values.end(), isBad, replacement);
}

}  // namespace

void ClothSolver::setLayerFriction(const btSoftBody& body, const std::vector<btScalar>& factors) {
  Impl::Taken* const taken = m_impl->find(body);
  if (!taken) return;
  taken->cloth.wetness().friction = factors;
  replaceBad(taken->cloth.wetness().friction, 1);
}

void ClothSolver::setLayerCling(const btSoftBody& body, const std::vector<btScalar>& pull,
                                const std::vector<btScalar>& shear) {
  Impl::Taken* const taken = m_impl->find(body);
  if (!taken) return;
  taken->cloth.wetness().pull = pull;
  taken->cloth.wetness().shear = shear;
  replaceBad(taken->cloth.wetness().pull, 0);
  replaceBad(taken->cloth.wetness().shear, 0);
}

PackedNodes* ClothSolver::packedNodes(const btSoftBody& body) {
  Impl::Taken* const taken = m_impl->find(body);
  return taken && !taken->cloth.hasNewMesh() ? &taken->cloth.nodes() : nullptr;
}

ClothSolver::GuardTotals ClothSolver::guardTotals() const {
  GuardTotals totals = m_impl->guard.totals();
  totals.longestStop = m_impl->guard.stops().longest();
  totals.mostStopped = m_impl->guard.stops().most();
  totals.placeOfMost = m_impl->guard.stops().placeOfMost();
  totals.inside = m_impl->mostInside;
  totals.crossing = m_impl->entanglements.most();
  return totals;
}

void ClothSolver::resetGuardTotals() {
  m_impl->guard.resetTotals();
  m_impl->entanglements.resetMost();
  m_impl->mostInside = 0;
}

std::vector<int> ClothSolver::stoppedNodes(const btSoftBody& body) const {
  std::vector<int> stopped;
  const Impl::Taken* const taken = m_impl->find(body);
  const auto& cloths = m_impl->inContact;
  const auto found = taken ? std::find(cloths.begin(), cloths.end(), &taken->cloth) : cloths.end();
  if (found == cloths.end() || !m_impl->parameters.guard) return stopped;
  const std::size_t first = m_impl->guard.firstNodes()[static_cast<std::size_t>(found - cloths.begin())];
  for (int node = 0; node < body.m_nodes.size(); ++node) {
    if (m_impl->guard.stops().wasStopped(first + static_cast<std::size_t>(node))) stopped.push_back(node);
  }
  return stopped;
}

void ClothSolver::setSmallStepCallback(SmallStepCallback callback) { m_impl->viewers.setCallback(std::move(callback)); }
void ClothSolver::addObserver(const std::shared_ptr<SmallStepObserver>& observer) { m_impl->viewers.add(observer); }
void ClothSolver::setLog(std::function<void(const std::string&)> log) { m_impl->logger = std::move(log); }

// Called at the start of every step. Bodies that left the world may have been deleted: only addresses are compared.
void ClothSolver::optimize(btAlignedObjectArray<btSoftBody*>& bodies, bool forceUpdate) {
  btDefaultSoftBodySolver::optimize(bodies, forceUpdate);
  m_impl->viewers.forgetTheDead();
  std::vector<std::unique_ptr<Impl::Taken>>& cloths = m_impl->before;
  cloths.swap(m_impl->cloths);
  m_impl->seeWhoIsLeft(bodies);
  for (int k = 0; k < bodies.size(); ++k) {
    const auto known = std::find_if(cloths.begin(), cloths.end(), [&](const std::unique_ptr<Impl::Taken>& taken) {
      return taken && &taken->cloth.body() == bodies[k];
    });
    if (m_impl->whyNotTaken(*bodies[k])[0] != '\0') {
      if (known != cloths.end()) giveBack(*bodies[k]);
      continue;
    }
    m_impl->cloths.push_back(known != cloths.end() ? std::move(*known) : std::make_unique<Impl::Taken>(*bodies[k]));
    m_impl->cloths.back()->cloth.followMesh();
  }
  cloths.clear();
}

void ClothSolver::transferState(StateArchive& archive, const btAlignedObjectArray<btSoftBody*>& bodies) {
  for (int k = 0; k < bodies.size(); ++k) {
    Impl::Taken* const taken = m_impl->find(*bodies[k]);
    unsigned char isTaken = taken ? 1 : 0;
    archive.local(isTaken);
    if (isTaken == 0) continue;
    if (taken) {
      taken->cloth.transferState(archive);
    } else if (archive.isChecking()) {
      PackedCloth(*bodies[k]).transferState(archive);
    } else {
      m_impl->cloths.push_back(std::make_unique<Impl::Taken>(*bodies[k]));
      m_impl->cloths.back()->cloth.transferState(archive);
    }
  }
  const bool hasBodies = m_impl->parameters.guard && m_impl->parameters.guard->bodies;
  if (hasBodies) archive.section("bodies near cloths", [&] { m_impl->bodies.transferState(archive); });
}

void ClothSolver::predictMotion(btScalar dt) {
  for (int k = 0; k < m_softBodySet.size(); ++k) {
    btSoftBody& body = *m_softBodySet[k];
    if (!body.isActive()) continue;
    Impl::Taken* const taken = m_impl->find(body);
    if (!taken) {
      body.predictMotion(dt);
      continue;
    }
    taken->cloth.follow(m_impl->parameters, dt);
    m_impl->warnOfSmallSteps(*taken);
    taken->cloth.predict(dt);
    m_impl->warnOfBadNode(*taken);
  }
}

void ClothSolver::processCollision(btSoftBody* body, const btCollisionObjectWrapper* object) {
  Impl::Taken* const taken = m_impl->find(*body);
  taken ? taken->cloth.collide(*object) : btDefaultSoftBodySolver::processCollision(body, object);
}

void ClothSolver::processCollision(btSoftBody* body, btSoftBody* other) {
  if (!m_impl->find(*body) && !m_impl->find(*other)) btDefaultSoftBodySolver::processCollision(body, other);
}

// From where the nodes are now.
void ClothSolver::Impl::beginGuard(int smallSteps) {
  guardedNodes = all.nodes;
  const bool hasBodies = parameters.guard->bodies && !bodies.isEmpty();
  if (hasBodies) guardedNodes.push_back(bodies.guarded(guardedNodes.front().h));
  guard.begin(guardedNodes, *parameters.guard, smallSteps, hasBodies ? &bodies.exemptions() : nullptr,
              &entanglements.exemptions());
}

// Those that are stepped, and after them those that stand.
void ClothSolver::Impl::takeGuarded(const btAlignedObjectArray<btSoftBody*>& softBodies) {
  guarded.clear();
  amongBodies.clear();
  inContact.clear();
  all.clear();
  const auto take = [this](PackedCloth& cloth, const ClothGuard::Cloth& nodes, int number) {
    all.nodes.push_back(nodes);
    all.numbers.push_back(number);
    all.isAnyPlaced = cloth.takePlaced() || nodes.isNew || all.isAnyPlaced;
    all.isAnyOpening = cloth.separateCoincident() || all.isAnyOpening;
    inContact.push_back(&cloth);
  };
  for (int k = 0; k < softBodies.size(); ++k) {
    Taken* const taken = find(*softBodies[k]);
    if (!taken || !softBodies[k]->isActive() || !taken->cloth.beginSmallSteps(parameters)) continue;
    guarded.push_back(&taken->cloth);
    amongBodies.push_back({softBodies[k], taken->cloth.guarded()});
    take(taken->cloth, amongBodies.back().guarded, k);
  }
  for (int k = 0; k < softBodies.size() && !guarded.empty(); ++k) {
    Taken* const taken = find(*softBodies[k]);
    if (!taken || std::find(guarded.begin(), guarded.end(), &taken->cloth) != guarded.end()) continue;
    if (const auto still = taken->cloth.standing()) take(taken->cloth, *still, k);
  }
}

// All cloths take each small step together, so that they can be kept apart after it.
void ClothSolver::Impl::solveGuarded(const btAlignedObjectArray<btSoftBody*>& softBodies, btScalar dt) {
  takeGuarded(softBodies);
  if (guarded.empty()) return;
  int count = 0;
  for (const PackedCloth* const cloth : guarded) count = std::max(count, cloth->smallSteps());
  const auto logThat = [this](const std::string& message) { log(message); };
  entanglements.begin(all, *parameters.guard, static_cast<double>(dt), logThat);
  const bool hasBodies = parameters.guard->bodies;
  if (hasBodies) {
    int others = 0;
    for (std::size_t k = guarded.size(); k < all.nodes.size(); ++k) others += all.nodes[k].nodeCount;
    bodies.begin(amongBodies, others, parameters.guard->thickness, dt);
    mostInside = std::max(mostInside, bodies.inside());
  } else {
    bodies.forget();
  }
  const long long forced = guard.totals().forced;
  beginGuard(count);
  for (int k = 0; k < count; ++k) {
    if (hasBodies && !bodies.covers(amongBodies)) {
      bodies.gather(amongBodies, static_cast<double>(k) / count);
      beginGuard(count - k);
    }
    for (PackedCloth* const cloth : guarded) {
      if (k < cloth->smallSteps()) cloth->takeSmallStep(k);
    }
    entanglements.push(all);
    if (hasBodies) bodies.go(static_cast<double>(k + 1) / count);
    guard.hold();
    if (hasBodies) bodies.recoil(guard.recoil(), static_cast<double>(k + 1) / count, dt / static_cast<btScalar>(count));
    for (PackedCloth* const cloth : guarded) {
      if (k < cloth->smallSteps()) cloth->show(viewers, k);
    }
  }
  if (guard.totals().forced > forced) entanglements.lookAgain(all, *parameters.guard, logThat);
  listContacts(guard, inContact, guarded.size());
  for (PackedCloth* const cloth : guarded) cloth->endSmallSteps();
  if (hasBodies) bodies.end();
}
void ClothSolver::solveConstraints(btScalar dt) {
  const bool isGuarded = m_impl->parameters.guard.has_value();
  for (int k = 0; k < m_softBodySet.size(); ++k) {
    btSoftBody& body = *m_softBodySet[k];
    if (!body.isActive()) continue;
    Impl::Taken* const taken = m_impl->find(body);
    if (!taken) {
      body.solveConstraints();
    } else if (!isGuarded) {
      taken->cloth.solve(m_impl->parameters, m_impl->viewers);
    }
  }
  isGuarded ? m_impl->solveGuarded(m_softBodySet, dt) : m_impl->bodies.forget();
  if (const auto failure = m_impl->viewers.dropFailed()) {
    m_impl->log("wetcloth: the small-step callback is no longer called: " + *failure);
  }
}

void ClothSolver::updateSoftBodies() {
  for (int k = 0; k < m_softBodySet.size(); ++k) {
    btSoftBody& body = *m_softBodySet[k];
    if (!body.isActive()) continue;
    Impl::Taken* const taken = m_impl->find(body);
    taken ? taken->cloth.finish() : body.integrateMotion();
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
