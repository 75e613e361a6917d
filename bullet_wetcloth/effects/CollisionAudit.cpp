// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/CollisionAudit.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/WetClothWorld.h"
#include "bullet_wetcloth/audit/AuditedBody.h"
#include "bullet_wetcloth/audit/PassageFinder.h"
#include "bullet_wetcloth/bullet/RequireFaces.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <LinearMath/btIDebugDraw.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

using collision::Pair;

/// Another soft body of the world.
struct CollisionAudit::Other {
  std::unique_ptr<AuditedBody> body;
  bool isInWorld = true;
  bool isNew = true;  // where it was before this substep is not known
};

namespace {

void requireValid(const CollisionAudit::Parameters& parameters) {
  if (parameters.tier == collision::Tier::exact && !collision::ContinuousCheck::hasExact()) {
    reject("CollisionAudit.tier", "this build has no exact tier; it needs Boost.Multiprecision");
  }
  if (parameters.mostPairsPerFace < 1) {
    rejectValue("CollisionAudit.mostPairsPerFace", parameters.mostPairsPerFace, "at least 1");
  }
}

// The substep as the world sees it [s].
double worldStepOf(const WetCloth& cloth, const Step& step) {
  return cloth.isInDeformableWorld() ? step.dt : step.dt / static_cast<double>(cloth.body().m_cfg.timescale);
}

Passage passageOf(Pair pair, const PassageFinder::Subject& subject, const collision::Contact& contact) {
  Passage passage;
  passage.pair = pair;
  passage.first = subject.first->body();
  passage.second = subject.second->body();
  const int firstNodes = pair == Pair::vertexFace ? 1 : 2;
  for (int i = 0; i < 4; ++i) {
    passage.nodes[i] = subject.nodes[i];
    const SweptFaces::Position& at = (i < firstNodes ? subject.first : subject.second)->position(subject.nodes[i]);
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      passage.points[i][k] = at.start(axis) + btScalar(contact.time) * (at.end(axis) - at.start(axis));
    }
    passage.points[i][3] = 0;
  }
  const btVector3(&p)[4] = passage.points;
  const btScalar a = btScalar(contact.where[0]);
  const btScalar b = btScalar(contact.where[1]);
  passage.position = pair == Pair::vertexFace ? p[1] + (p[2] - p[1]) * a + (p[3] - p[1]) * b : p[0] + (p[1] - p[0]) * a;
  return passage;
}

}  // namespace

CollisionAudit::CollisionAudit(Parameters parameters) : m_own(std::make_unique<AuditedBody>()) {
  m_passages.reserve(static_cast<std::size_t>(kMostKept));
  setParameters(std::move(parameters));
}

void CollisionAudit::setParameters(Parameters parameters) {
  requireValid(parameters);
  if (!m_finder || parameters.tier != m_parameters.tier) {
    std::unique_ptr<PassageFinder> finder = makeFinder(parameters.tier);
    std::unique_ptr<PassageFinder> smallFinder = makeFinder(parameters.tier);
    if (m_finder) m_totals.candidatePairs += m_finder->candidates() + m_smallFinder->candidates();
    m_finder = std::move(finder);
    m_smallFinder = std::move(smallFinder);
  }
  if (!parameters.others) m_others.clear();
  m_parameters = std::move(parameters);
}

std::unique_ptr<PassageFinder> CollisionAudit::makeFinder(collision::Tier tier) {
  const auto count = [this](Pair pair, const PassageFinder::Subject& subject, const collision::Contact& contact) {
    ++(pair == Pair::vertexFace ? m_totals.vertexFace : m_totals.edgeEdge);
    Passage passage = passageOf(pair, subject, contact);
    passage.time = m_lookBegin + contact.time * (m_lookEnd - m_lookBegin);
    if (m_passages.size() < static_cast<std::size_t>(kMostKept)) m_passages.push_back(passage);
    if (m_parameters.onPassage) m_parameters.onPassage(passage);
  };
  return std::make_unique<PassageFinder>(tier, count);
}

CollisionAudit::~CollisionAudit() = default;

AuditTotals CollisionAudit::totals() const {
  AuditTotals totals = m_totals;
  totals.candidatePairs += m_finder->candidates() + m_smallFinder->candidates();
  return totals;
}

void CollisionAudit::attach(WetCloth& cloth) {
  const btSoftBody& body = cloth.body();
  requireFaces("CollisionAudit", body);
  m_cloth = &cloth;
  m_own->build(body);
  reset();
}

void CollisionAudit::detach(WetCloth&) {
  m_cloth = nullptr;
  reset();
}

void CollisionAudit::reset() {
  m_isFollowing = false;
  m_isPending = false;
}

void CollisionAudit::apply(WetCloth& cloth, const Step& step) {
  const bool isNextSubstep = m_isFollowing && step.time - m_time < 1.5 * m_dt;
  if (isNextSubstep) {
    lookUntil(step.time);
  } else {
    restart();
  }
  m_time = step.time;
  m_dt = worldStepOf(cloth, step);
  m_isPending = true;
  observe();
}

// One that has left the world may have been deleted.
bool CollisionAudit::isBodyThere() const { return m_cloth->world().isInWorld(m_cloth->body()); }

void CollisionAudit::look() {
  if (!m_cloth || !m_isFollowing || !isBodyThere() || !m_own->fits(m_cloth->body())) return;
  const double end = m_isPending ? m_time + m_dt : m_time;
  lookUntil(end);
  m_time = end;
  m_isPending = false;
}

void CollisionAudit::restart() {
  m_passages.clear();
  m_finder->forget();
  m_smallFinder->forget();
  m_own->restart();
  m_others.clear();
  followOthers();
  m_isFollowing = true;
}

void CollisionAudit::observe() {
  m_own->observe();
  for (const Other& other : m_others) other.body->observe();
}

void CollisionAudit::lookUntil(double time) {
  m_passages.clear();
  m_lookBegin = m_time;
  m_lookEnd = time;
  m_totals.seconds += time - m_time;
  if (m_isPending) ++m_totals.substeps;
  const bool ownMoved = m_own->advance();
  const bool othersMoved = followOthers();
  const bool isComplete = (!ownMoved && !othersMoved) || lookAtWhole();
  if (!lookAtSmallSteps(time) || !isComplete) sayIncomplete();
}

// What no small steps are known of. Returns whether all pairs were looked at.
bool CollisionAudit::lookAtWhole() {
  const bool hasSmallSteps = m_own->smallSteps() > 0;
  bool isFitted = false;
  const auto own = [&]() -> const SweptFaces& {
    if (!isFitted) m_own->whole().refit();
    isFitted = true;
    return m_own->whole();
  };
  m_finder->begin(mostCandidates());
  if (m_parameters.self && !hasSmallSteps) m_finder->lookAt(own());
  for (const Other& other : m_others) {
    if (other.isNew || (hasSmallSteps && other.body->smallSteps() > 0)) continue;
    other.body->whole().refit();
    m_finder->lookAt(own(), other.body->whole());
  }
  return m_finder->finish();
}

bool CollisionAudit::lookAtSmallSteps(double time) {
  const int count = smallSteps();
  bool isComplete = true;
  for (int k = 0; k < count; ++k) {
    m_own->takeSmallStep(k);
    for (const Other& other : m_others) other.body->takeSmallStep(k);
    m_lookBegin = m_time + (time - m_time) * k / count;
    m_lookEnd = m_time + (time - m_time) * (k + 1) / count;
    if (m_own->smallSteps() > 0) isComplete = lookAtSmallStep() && isComplete;
  }
  m_own->endSmallSteps();
  for (const Other& other : m_others) other.body->endSmallSteps();
  m_lookEnd = time;
  return isComplete;
}

bool CollisionAudit::lookAtSmallStep() {
  m_own->small().refit();
  m_smallFinder->begin(mostCandidates());
  if (m_parameters.self) m_smallFinder->lookAt(m_own->small());
  for (const Other& other : m_others) {
    if (other.isNew || other.body->smallSteps() == 0) continue;
    other.body->small().refit();
    m_smallFinder->lookAt(m_own->small(), other.body->small());
  }
  return m_smallFinder->finish();
}

int CollisionAudit::smallSteps() const {
  int most = m_own->smallSteps();
  for (const Other& other : m_others) most = std::max(most, other.body->smallSteps());
  return most;
}

long long CollisionAudit::mostCandidates() const {
  return static_cast<long long>(m_parameters.mostPairsPerFace) * m_cloth->body().m_faces.size();
}

void CollisionAudit::sayIncomplete() {
  if (m_totals.incompleteSubsteps++ > 0) return;
  m_cloth->log("CollisionAudit: at " + std::to_string(m_lookEnd) + " s there were more than " +
               std::to_string(mostCandidates()) + " pairs to look at in a substep, and the rest was left out; " +
               "totals().incompleteSubsteps counts such substeps, Parameters::mostPairsPerFace sets the limit");
}

// Returns whether any of them moved.
bool CollisionAudit::followOthers() {
  if (!m_parameters.others) return false;
  for (Other& other : m_others) other.isInWorld = false;
  bool moved = false;
  const btAlignedObjectArray<btSoftBody*>& bodies = m_cloth->world().softBodies();
  for (int i = 0; i < bodies.size(); ++i) {
    const btSoftBody& body = *bodies[i];
    if (&body != &m_cloth->body() && body.m_faces.size() > 0 && isOurs(body)) moved |= follow(body);
  }
  const auto isGone = [](const Other& other) { return !other.isInWorld; };
  m_others.erase(std::remove_if(m_others.begin(), m_others.end(), isGone), m_others.end());
  return moved;
}

bool CollisionAudit::follow(const btSoftBody& body) {
  const auto isIt = [&](const Other& other) { return other.body->body() == &body; };
  auto found = std::find_if(m_others.begin(), m_others.end(), isIt);
  if (found == m_others.end()) {
    m_others.push_back({std::make_unique<AuditedBody>()});
    found = m_others.end() - 1;
  }
  found->isInWorld = true;
  found->isNew = !found->body->fits(body);
  if (!found->isNew) return found->body->advance();
  found->body->build(body);
  return false;
}

// Of two cloths that look at each other, the one that was added first counts.
bool CollisionAudit::isOurs(const btSoftBody& other) const {
  for (const WetCloth& cloth : m_cloth->world().cloths()) {
    if (&cloth == m_cloth) return true;
    if (&cloth.body() != &other) continue;
    bool looksAtOthers = false;
    cloth.forEach<CollisionAudit>(
        [&](const CollisionAudit& audit) { looksAtOthers = looksAtOthers || audit.m_parameters.others; });
    return !looksAtOthers;
  }
  return true;
}

void CollisionAudit::draw(btIDebugDraw& drawer) const {
  const btVector3 red(1, 0, 0);
  const btVector3 yellow(1, 1, 0);
  for (const Passage& passage : m_passages) {
    const btVector3(&p)[4] = passage.points;
    const bool isFace = passage.pair == Pair::vertexFace;
    const btVector3& colour = isFace ? red : yellow;
    if (!isFace) drawer.drawLine(p[0], p[1], colour);
    drawer.drawLine(p[2], p[3], colour);
    if (isFace) {
      drawer.drawLine(p[1], p[2], colour);
      drawer.drawLine(p[3], p[1], colour);
    }
    const btScalar arm = (p[3] - p[2]).length() / 4;
    for (int axis = 0; axis < 3; ++axis) {
      btVector3 along(0, 0, 0);
      along[axis] = arm;
      drawer.drawLine(passage.position - along, passage.position + along, colour);
    }
  }
}

// passages() of the last look are left out: they name what was seen, and nothing builds on them.
void CollisionAudit::transferState(StateArchive& archive) {
  archive.value(m_totals.vertexFace, m_totals.edgeEdge, m_totals.candidatePairs, m_totals.substeps);
  archive.value(m_totals.incompleteSubsteps, m_totals.seconds);
  archive.value(m_isFollowing, m_isPending, m_time, m_dt, m_lookEnd);
  if (isBodyThere()) m_own->transferState(archive, m_cloth->body());
  transferOthers(archive);
  m_finder->transferState(archive, m_cloth->world().softBodies());
  m_smallFinder->transferState(archive, m_cloth->world().softBodies());
  if (archive.isRestoring()) m_passages.clear();
}

void CollisionAudit::transferOthers(StateArchive& archive) {
  const btAlignedObjectArray<btSoftBody*>& bodies = m_cloth->world().softBodies();
  const auto numberOf = [&](const Other& other) {
    return bodies.findLinearSearch(const_cast<btSoftBody*>(other.body->body()));
  };
  // A body that has left the world is forgotten in the next step.
  const auto isThere = [&](const Other& other) { return numberOf(other) < bodies.size(); };
  std::vector<Other*> saved;
  for (Other& other : m_others) {
    if (archive.isSaving() && isThere(other)) saved.push_back(&other);
  }
  std::vector<Other> read;
  const std::size_t count = archive.count(saved.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (!archive.isSaving()) read.push_back({std::make_unique<AuditedBody>()});
    Other& other = archive.isSaving() ? *saved[i] : read[i];
    const int number = archive.place(archive.isSaving() ? numberOf(other) : 0, bodies.size(), "soft body of an audit");
    archive.value(other.isNew);
    other.body->transferState(archive, *bodies[number]);
  }
  if (archive.isRestoring()) m_others = std::move(read);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
